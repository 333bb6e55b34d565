#include "server/edits/proposal.h"

#include <cmath>

#include "common/physics/part_places.h"
#include "common/stages/make_stages.h"
#include "common/topology/join.h"

namespace seam {
namespace {

/// How far from where a bond puts them parts may be in our copy, m: two copies of fast things.
constexpr float kBondReach = 2;

}  // namespace

bool MayPropose(const Topology& topology, const Edit& edit) {
  if (edit.cause != EditCause::kPhysics) return false;
  if (edit.kind == EditKind::kBreak) {
    const Joint& joint = topology.scene().joints[static_cast<std::size_t>(edit.joint)];
    return joint.kind == JointKind::kGlue && (joint.strength > 0 || joint.grouped);
  }
  return IsJoin(topology.scene(), topology.composition(), edit) ||
         MayGroup(topology.scene(), topology.composition(), edit);
}

bool PlausibleProposal(const World& world, const Edit& edit) {
  if (edit.kind != EditKind::kBond) return true;
  const BodyState a = PartPose(world, edit.a), b = PartPose(world, edit.b);
  const float c = std::cos(a.angle), s = std::sin(a.angle);
  const Vec2 wanted = a.position + Vec2(c * edit.x - s * edit.y, s * edit.x + c * edit.y);
  return (wanted - b.position).norm() < kBondReach;
}

}  // namespace seam
