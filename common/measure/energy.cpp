#include "common/measure/energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/check.h"
#include "common/physics/water_push.h"

namespace seam {
namespace {

constexpr double kTurn = 6.283185307179586;   // rad

}  // namespace

EnergyMeter::EnergyMeter(const Scene& scene, const Composition& composition)
    : waters_(scene.waters), gravity_(scene.gravity.cast<double>()) {
  for (const Assembly& assembly : composition.assemblies) {
    if (assembly.anchored) continue;
    masses_.push_back(AssemblyProperties(scene, assembly));
    if (!waters_.empty()) wet_shapes_.push_back(WetShapeOf(scene, assembly));
  }
  const auto mass = [&](const JointEnd& end) {
    return end.moving < 0 ? 0 : masses_[static_cast<std::size_t>(end.moving)].mass;
  };
  for (const JointEnds& ends : FindJointEnds(scene, composition)) {
    const bool sprung = ends.kind == JointKind::kWheel || ends.kind == JointKind::kDistance;
    if (!sprung || ends.frequency_hz <= 0) continue;
    // As b2LinearStiffness: of the reduced mass, where an anchored side weighs endlessly.
    const double a = mass(ends.a), b = mass(ends.b);
    const double reduced = a > 0 && b > 0 ? a * b / (a + b) : a + b;
    const double omega = kTurn * ends.frequency_hz;
    springs_.push_back({ends, reduced * omega * omega});
  }
}

/// Lifting an area of water from its place to the level: its weight times the depth of its middle.
/// The slope of this by a thing's height is the buoyancy, and by its angle the torque.
double EnergyMeter::InWater(const std::vector<BodyState>& moving) const {
  double energy = 0;
  for (std::size_t i = 0; i < wet_shapes_.size(); ++i) {
    FloatingBody body;
    body.position = moving[i].position.cast<double>();
    body.cosine = std::cos(static_cast<double>(moving[i].angle));
    body.sine = std::sin(static_cast<double>(moving[i].angle));
    for (const Water& water : waters_) {
      const Bounds bounds = BoundsOf(water);
      const AreaMoments wet = Displaced(wet_shapes_[i], nullptr, body, bounds);
      const double weight = static_cast<double>(water.density) * wet.area * -gravity_.y();
      energy += weight * (bounds.max.y() - wet.centre.y());
    }
  }
  return energy;
}

double EnergyMeter::Of(const std::vector<BodyState>& moving) const {
  SEAM_ASSERT(moving.size() == masses_.size());
  if (!std::all_of(moving.begin(), moving.end(), IsFinite)) {
    return std::numeric_limits<double>::infinity();
  }
  double energy = InWater(moving);
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const BodyState& state = moving[i];
    const double spin = double{state.spin};
    energy += masses_[i].mass * state.velocity.cast<double>().squaredNorm() / 2;
    energy += masses_[i].inertia * spin * spin / 2;
    energy -= masses_[i].mass * gravity_.dot(Pose(state).ToWorld(masses_[i].centre));
  }
  for (const Spring& spring : springs_) {
    const Eigen::Vector2d apart =
        spring.ends.b.PointNow(moving) - spring.ends.a.PointNow(moving);
    const double stretch = spring.ends.kind == JointKind::kWheel
                               ? apart.dot(spring.ends.a.AxisNow(moving))
                               : apart.norm() - spring.ends.length;
    energy += spring.stiffness * stretch * stretch / 2;
  }
  return energy;
}

}  // namespace seam
