#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/lab/check/scene_check.h"

namespace seam {
namespace {

/// Where a joint begins may be so far outside its limits: scenes are written with two decimals. m
/// or rad.
constexpr float kOutside = 0.011f;

/// What the limits bound, at the start: an angle, a length, or how far the ends of a slide are
/// apart along it.
float Begins(const Joint& joint) {
  const Vec2 apart = joint.anchor_b - joint.anchor_a;
  if (joint.kind == JointKind::kDistance) return apart.norm();
  const bool slides = joint.kind == JointKind::kPrismatic || joint.kind == JointKind::kWheel;
  return slides ? apart.dot(joint.axis) : joint.turn;
}

/// Whether a slide of so much would carry its part out of the scene.
bool LeavesBounds(const Scene& scene, const Joint& joint, float along) {
  const Vec2 at = joint.anchor_a + along * joint.axis;
  return (scene.bounds_min - at).maxCoeff() > 0 || (at - scene.bounds_max).maxCoeff() > 0;
}

}  // namespace

void FindJointLimits(const Scene& scene, std::vector<Finding>* findings) {
  for (const Joint& joint : scene.joints) {
    const auto found = [&](const std::string& what) {
      findings->push_back({joint.line, fmt::format("joint '{}': {}", joint.name, what)});
    };
    if (joint.kind == JointKind::kRope && joint.length > 0) {
      const float placed = (joint.anchor_b - joint.anchor_a).norm();
      if (placed > joint.length + kOutside) {
        found(
            fmt::format("its ends begin {:.2f} m apart, the rope is {:g} m", placed, joint.length));
      }
    }
    if (!joint.limited) continue;
    const float begins = Begins(joint);
    if (begins < joint.lower - kOutside || begins > joint.upper + kOutside) {
      found(fmt::format("begins at {:.3g}, outside its limits {:g} to {:g}", begins, joint.lower,
                        joint.upper));
    }
    if (joint.kind != JointKind::kPrismatic) continue;
    for (const float limit : {joint.lower, joint.upper}) {
      if (!LeavesBounds(scene, joint, limit)) continue;
      found(
          fmt::format("its limit {:g} lies out of the scene's bounds: it is never reached", limit));
    }
  }
}

}  // namespace seam
