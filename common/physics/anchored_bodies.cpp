#include "common/physics/anchored_bodies.h"

#include <algorithm>
#include <cmath>

#include "common/physics/world_build.h"
#include "common/scene/connectors.h"
#include "common/scene/forces.h"
#include "common/scene/joint_kinds.h"

namespace seam {
namespace {

/// Sides of the squares, m. In each of its steps the engine walks through the contacts of the later
/// body of a pair, so a body should not have those of a whole city.
constexpr float kSquare = 16;

}  // namespace

std::vector<bool> ShareBodies(const Scene& scene, const Composition& composition) {
  std::vector<bool> share;
  for (const Assembly& a : composition.assemblies) {
    share.push_back(a.anchored && a.kinematic < 0);
  }
  const auto keep = [&](PartId part) {
    const int index = composition.assembly_of_part[static_cast<std::size_t>(part)];
    if (index >= 0) share[static_cast<std::size_t>(index)] = false;
  };
  for (const Joint& joint : scene.joints) {
    const bool strong = joint.kind != JointKind::kGlue || joint.strength <= 0;
    if (joint.gone || (IsRigid(joint, scene.solver) && strong)) continue;
    keep(joint.a);
    keep(joint.b);
  }
  for (const Part& part : scene.parts) {
    if (part.gone) continue;
    if (!part.connectors->empty() || part.conveyor->speed != 0) keep(part.id);
  }
  for (const Seat& seat : scene.seats) keep(seat.part);
  for (const Thrust& thrust : scene.thrusts) keep(thrust.part);
  if (std::count(share.begin(), share.end(), true) < kShareFrom) {
    share.assign(share.size(), false);
  }
  return share;
}

const AnchoredBodies::Body& AnchoredBodies::For(const Part& root) {
  const auto square = [](float x) { return static_cast<int>(std::floor(x / kSquare)); };
  Body& body = bodies_[{square(root.position.x()), square(root.position.y())}];
  if (body.body != nullptr) return body;
  const auto middle = [&](float x) { return kSquare * (static_cast<float>(square(x)) + 0.5f); };
  body.frame.position = {middle(root.position.x()), middle(root.position.y())};
  b2BodyDef def;
  def.position = ToB2(body.frame.position);
  body.body = world_->CreateBody(&def);
  return body;
}

}  // namespace seam
