#include "common/physics/proposal.h"

#include <cmath>

#include "common/physics/group_stage.h"
#include "common/physics/join.h"
#include "common/physics/mass.h"

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

BodyState PartPose(const World& world, PartId part) {
  const Composition& c = world.composition();
  const std::vector<Part>& parts = world.scene().parts;
  const Part& own = parts[static_cast<std::size_t>(part)];
  const Assembly& assembly = c.assemblies[static_cast<std::size_t>(
      c.assembly_of_part[static_cast<std::size_t>(part)])];
  BodyState pose;
  pose.position = own.position;
  pose.angle = own.angle;
  if (assembly.anchored) return pose;
  const Part& root = parts[static_cast<std::size_t>(assembly.id)];
  const BodyState body = world.Read(world.BodyOfId(assembly.id));
  const Eigen::Vector2d local = ToRootFrame(own, root, Eigen::Vector2d(0, 0));
  const double angle = static_cast<double>(body.angle);
  const double co = std::cos(angle), si = std::sin(angle);
  const Eigen::Vector2d arm(co * local.x() - si * local.y(), si * local.x() + co * local.y());
  pose = body;
  pose.position = (body.position.cast<double>() + arm).cast<float>();
  pose.angle = body.angle + (own.angle - root.angle);
  return pose;
}

bool PlausibleProposal(const World& world, const Edit& edit) {
  if (edit.kind != EditKind::kBond) return true;
  const BodyState a = PartPose(world, edit.a), b = PartPose(world, edit.b);
  const float c = std::cos(a.angle), s = std::sin(a.angle);
  const Vec2 wanted =
      a.position + Vec2(c * edit.x - s * edit.y, s * edit.x + c * edit.y);
  return (wanted - b.position).norm() < kBondReach;
}

}  // namespace seam
