/// ExactStep: continuous collision, which knows no joints.

#include "common/physics/exact/engine_members.h"
#include "common/physics/exact/exact_step.h"

namespace seam {

/// Listens while the engine does continuous collision. Its blow on a mechanism's body by something
/// that does not give way is not heard of: the whole mechanism has it in the next step. Between
/// moving bodies (bullets) the blow counts, and `struck` remembers whom it met.
class ExactStep::Quiet : public b2ContactListener {
 public:
  Quiet(b2ContactListener* listener, std::vector<Slot>* slots)
      : listener_(listener), slots_(slots) {}
  void BeginContact(b2Contact* contact) override { listener_->BeginContact(contact); }
  void EndContact(b2Contact* contact) override { listener_->EndContact(contact); }
  void PreSolve(b2Contact* contact, const b2Manifold* old) override {
    listener_->PreSolve(contact, old);
  }
  void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override {
    b2Body* const a = contact->GetFixtureA()->GetBody();
    b2Body* const b = contact->GetFixtureB()->GetBody();
    const bool both = Moves(a) && Moves(b);
    bool ours = false;
    for (b2Body* body : {a, b}) {
      if (!Moves(body)) continue;
      Slot& slot = (*slots_)[static_cast<std::size_t>(IndexOf(body))];
      slot.struck = slot.struck || both;
      ours = ours || slot.solved;
    }
    if (both || !ours) listener_->PostSolve(contact, impulse);
  }

 private:
  b2ContactListener* const listener_;
  std::vector<Slot>* const slots_;
};

/// As the engine's, but what it took back to where it hit keeps its velocity and its joints.
void ExactStep::Continuous(const b2TimeStep& step, const Pace& pace) {
  b2ContactListener* const listener = world_->GetContactManager().m_contactListener;
  Quiet quiet(listener, &slots_);
  for (Slot& slot : slots_) slot.struck = false;
  world_->SetContactListener(&quiet);
  (world_->*Member(EngineSolveToi()))(step);
  world_->SetContactListener(listener);
  RejoinWhatMoved(step.dt, pace);
}

void ExactStep::RejoinWhatMoved(float h, const Pace& pace) {
  std::vector<int> moved;
  for (const int m : solved_) {
    const Found& found = found_[static_cast<std::size_t>(m)];
    for (const int slot : found.slots) {
      const Slot& s = slots_[static_cast<std::size_t>(slot)];
      if (!s.body->IsAwake() || Told(s)) continue;
      moved.insert(moved.end(), found.mechanisms.begin(), found.mechanisms.end());
      break;
    }
  }
  if (moved.empty()) return;
  for (Slot& slot : slots_) slot.island = -1;
  for (const int m : moved) {
    if (slots_[static_cast<std::size_t>(mechanisms_[static_cast<std::size_t>(m)].slots[0])]
            .island >= 0) {
      continue;
    }
    Found& found = found_[static_cast<std::size_t>(m)];
    if (!Gather(m, &found)) continue;
    Prepare(h, &found);
    if (!found.island) continue;
    LoadPoses(&found);
    bool struck = false;
    for (ExactBody& q : found.island->bodies) {
      if (q.slot < 0) continue;
      const Slot& s = slots_[static_cast<std::size_t>(q.slot)];
      struck = struck || s.struck;
      if (s.struck || !s.known) continue;
      q.vx = s.vx;
      q.vy = s.vy;
      q.w = s.w;
    }
    found.island->Rejoin(pace, struck);
    SavePoses(found);
  }
}

}  // namespace seam
