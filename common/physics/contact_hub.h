#pragma once
/// Forwards the engine's contact events to the stages that listen, and to the meter.

#include <vector>

#include "common/physics/stage.h"
#include "common/physics/world_contacts.h"

namespace seam {

class ContactHub : public b2ContactListener {
 public:
  ContactHub(ImpulseMeter& meter, std::vector<Stage*> stages)
      : meter_(meter), stages_(std::move(stages)) {}

  void BeginContact(b2Contact* contact) override {
    meter_.BeginContact(contact);
    for (Stage* stage : stages_) stage->BeginContact(contact);
  }
  void EndContact(b2Contact* contact) override {
    meter_.EndContact(contact);
    for (Stage* stage : stages_) stage->EndContact(contact);
  }
  void PreSolve(b2Contact* contact, const b2Manifold* old) override {
    meter_.PreSolve(contact, old);
    for (Stage* stage : stages_) stage->PreSolve(contact);
  }
  void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override {
    meter_.PostSolve(contact, impulse);
    for (Stage* stage : stages_) stage->PostSolve(contact, impulse);
  }

 private:
  ImpulseMeter& meter_;
  std::vector<Stage*> stages_;
};

}  // namespace seam
