#include "server/edits/proposal.h"

#include <cmath>

#include "common/base/geometry.h"
#include "common/physics/part_places.h"
#include "common/stages/make_stages.h"
#include "common/topology/grip.h"
#include "common/topology/join.h"

namespace seam {
namespace {

/// Largest distance of a part from its place in a bond, m, in our copy: both parts may be fast
/// copies.
constexpr float kBondReach = 2;
/// Like kBondReach, between a hand and the held part: both are slower.
constexpr float kGripReach = 1;
/// Largest deviation of the angle, rad.
constexpr float kBondTurn = 1;

}  // namespace

bool MayPropose(const Topology& topology, const Edit& edit) {
  if (edit.cause != EditCause::kPhysics) return false;
  if (const BreakEdit* broken = edit.As<BreakEdit>()) {
    const Joint& joint = topology.scene().joints[static_cast<std::size_t>(broken->joint)];
    if (IsGrip(joint)) return true;
    return joint.kind == JointKind::kGlue && (joint.strength > 0 || joint.grouped);
  }
  const BondEdit* bond = edit.As<BondEdit>();
  return bond != nullptr && (IsJoin(topology.scene(), topology.composition(), *bond) ||
                             MayGroup(topology.scene(), topology.composition(), *bond) ||
                             MayGrip(topology.scene(), *bond));
}

bool PlausibleProposal(const World& world, const Edit& edit) {
  const BondEdit* bond = edit.As<BondEdit>();
  if (bond == nullptr) return true;
  const BodyState a = PartPose(world, bond->a), b = PartPose(world, bond->b);
  if (bond->cause == BondCause::kGrip) {
    const Vec2 tip = FingertipOf(world.scene(), bond->b).value_or(Vec2(0, 0));
    const Vec2 held = a.position + Turned(bond->position, a.angle);
    return (held - b.position - Turned(tip, b.angle)).norm() < kGripReach;
  }
  const Vec2 wanted = a.position + Turned(bond->position, a.angle);
  const float turned = WrapAngle(a.angle + bond->angle - b.angle);
  return (wanted - b.position).norm() < kBondReach && std::fabs(turned) < kBondTurn;
}

}  // namespace seam
