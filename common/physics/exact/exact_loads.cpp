/// ExactStep: heavy bodies that lie on much lighter ones. Rounds over contacts pass a load on only
/// as fast as the light bodies' masses allow, so that it falls meanwhile.

#include <algorithm>

#include "common/physics/engine_members.h"
#include "common/physics/exact/exact_step.h"

namespace seam {
namespace {

/// A body is a load for one that has less than this share of its mass. Soft contacts carry others.
constexpr float kLoadShare = 1.0f / 30;

}  // namespace

/// Adds each body that can be a load as a mechanism of its own, after those with joints.
void ExactStep::FindLoads() {
  float lightest = b2_maxFloat;
  for (const Slot& slot : slots_) {
    if (Moves(slot.body)) lightest = std::min(lightest, slot.body->GetMass());
  }
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    Slot& slot = slots_[i];
    if (slot.mechanism >= 0 || !Moves(slot.body)) continue;
    if (lightest >= kLoadShare * slot.body->GetMass()) continue;
    slot.mechanism = static_cast<int>(mechanisms_.size());
    mechanisms_.emplace_back();
    mechanisms_.back().slots.push_back(static_cast<int>(i));
    mechanisms_.back().lightest = b2_maxFloat;
  }
  found_.resize(mechanisms_.size());
}

/// True for a mechanism with joints, and for a load that lies on something much lighter.
bool ExactStep::Counts(const Mechanism& mechanism) const {
  if (!mechanism.joints.empty()) return true;
  b2Body* const body = slots_[static_cast<std::size_t>(mechanism.slots[0])].body;
  const b2Vec2 gravity = world_->GetGravity();
  for (const b2ContactEdge* edge = body->GetContactList(); edge != nullptr; edge = edge->next) {
    const b2Body* const other = edge->other;
    if (!Moves(other) || other->GetMass() >= kLoadShare * body->GetMass()) continue;
    if (!Pushes(edge->contact)) continue;
    if (b2Dot(other->GetWorldCenter() - body->GetWorldCenter(), gravity) > 0) return true;
  }
  return false;
}

}  // namespace seam
