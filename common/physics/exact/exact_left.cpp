/// ExactStep: state of islands that are left to the engine.

#include <algorithm>
#include <array>

#include "common/physics/engine_members.h"
#include "common/physics/exact/exact_step.h"
#include "common/physics/world_couplings.h"

namespace seam {
namespace {

/// Limit of an impulse, as a multiple of all momentum.
constexpr double kFallbackImpulseMost = 3;

double Length(const b2Vec2& v) { return static_cast<double>(v.Length()); }

}  // namespace

std::vector<WorldSnapshot::Left> ExactStep::Left() const {
  std::vector<WorldSnapshot::Left> left;
  for (std::size_t m = 0; m < found_.size(); ++m) {
    if (found_[m].fallback_steps <= 0) continue;
    b2Body* const lowest = slots_[static_cast<std::size_t>(mechanisms_[m].slots[0])].body;
    left.push_back({IndexOf(lowest), found_[m].fallback_steps});
  }
  return left;
}

void ExactStep::Leave(const std::vector<WorldSnapshot::Left>& left) {
  for (const auto& [body, steps] : left) {
    const int slot = slot_of_[static_cast<std::size_t>(body)];
    const int m = slot < 0 ? -1 : slots_[static_cast<std::size_t>(slot)].mechanism;
    if (m < 0 || mechanisms_[static_cast<std::size_t>(m)].slots[0] != slot) continue;
    found_[static_cast<std::size_t>(m)].fallback_steps = steps;
  }
}

/// Removes the last step's impulses if they are too large. The engine warm-starts from them, and
/// its few iterations do not recover from those that a jam or a taut rope has left here.
void ExactStep::LeaveToEngine(float h, const Found& found) {
  if (found.slots.empty()) return;
  double mass = 0, momentum = 0, fastest = 0;
  b2Vec2 sum(0, 0);
  for (const int slot : found.slots) {
    const b2Body* body = slots_[static_cast<std::size_t>(slot)].body;
    mass += static_cast<double>(body->GetMass());
    sum += body->GetMass() * body->GetLinearVelocity();
  }
  const bool fixed =
      std::any_of(found.contacts.begin(), found.contacts.end(), [](b2Contact* contact) {
        return !Moves(contact->GetFixtureA()->GetBody()) ||
               !Moves(contact->GetFixtureB()->GetBody());
      });
  const b2Vec2 mean = fixed ? b2Vec2(0, 0) : 1 / static_cast<float>(mass) * sum;
  for (const int slot : found.slots) {
    b2Body* body = slots_[static_cast<std::size_t>(slot)].body;
    momentum +=
        static_cast<double>(body->GetMass()) * Length(body->GetLinearVelocity() - mean) +
        static_cast<double>(h) * (static_cast<double>(body->GetMass() * body->GetGravityScale()) *
                                      Length(world_->GetGravity()) +
                                  Length(body->*Member(BodyForce())));
  }
  double pressed = 0;
  for (b2Contact* contact : found.contacts) {
    const b2Manifold& manifold = *contact->GetManifold();
    for (int i = 0; i < manifold.pointCount; ++i) {
      pressed = std::max(pressed, static_cast<double>(manifold.points[i].normalImpulse));
    }
    for (const b2Fixture* fixture : {contact->GetFixtureA(), contact->GetFixtureB()}) {
      const b2Body* body = fixture->GetBody();
      if (!Moves(body)) fastest = std::max(fastest, Length(body->GetLinearVelocity()));
    }
  }
  momentum += mass * fastest;
  for (const int m : found.mechanisms) {
    for (const int j : mechanisms_[static_cast<std::size_t>(m)].joints) {
      const ExactJoint& joint = joints_[static_cast<std::size_t>(j)];
      // The engine's reaction uses the directions of its last step, and a new joint has none.
      const b2Vec2 force = ForcesOf(joint.made, 1 / h).on_a;
      pressed = std::max(pressed, static_cast<double>(h) * Length(force));
      if (joint.drives) momentum += static_cast<double>(h) * joint.most;
    }
  }
  if (pressed <= kFallbackImpulseMost * momentum) return;
  for (b2Contact* contact : found.contacts) {
    b2Manifold& manifold = *contact->GetManifold();
    for (int i = 0; i < manifold.pointCount; ++i) {
      manifold.points[i].normalImpulse = manifold.points[i].tangentImpulse = 0;
    }
  }
  const std::array<Row, kJointRowsMost> none;
  for (const int m : found.mechanisms) {
    for (const int j : mechanisms_[static_cast<std::size_t>(m)].joints) {
      StoreImpulses(joints_[static_cast<std::size_t>(j)], none.data());
    }
  }
}

}  // namespace seam
