#include "common/measure/energy.h"

#include <algorithm>
#include <limits>

#include "common/base/check.h"
#include "common/base/geometry.h"
#include "common/scene/joint_kinds.h"
#include "common/scene/water.h"
#include "common/stages/water/water_push.h"

namespace seam {

EnergyMeter::EnergyMeter(const Scene& scene, const Composition& composition)
    : waters_(scene.waters), gravity_(scene.gravity.cast<double>()), imposed_(scene, composition) {
  for (const Assembly& assembly : composition.assemblies) {
    if (assembly.anchored) continue;
    masses_.push_back(AssemblyProperties(scene, assembly));
    if (!waters_.empty()) wet_shapes_.push_back(WetShapeOf(scene, assembly));
  }
  // Mass of a side, kg, or its moment about its origin, kg m^2; 0 for an anchored or kinematic one.
  const auto load = [&](const JointEnd& end, bool turns) {
    if (end.moving < 0 || end.moving >= static_cast<int>(masses_.size())) return 0.0;
    const MassProperties& own = masses_[static_cast<std::size_t>(end.moving)];
    return turns ? own.inertia + own.mass * own.centre.squaredNorm() : own.mass;
  };
  for (const JointEnds& ends : FindJointEnds(scene, composition)) {
    if (ends.frequency_hz <= 0) continue;
    // As b2LinearStiffness and b2AngularStiffness: uses the reduced mass or moment; an anchored
    // side has infinite mass.
    const bool turns = SpringOf(ends.kind) == JointSpring::kAngle;
    const double a = load(ends.a, turns), b = load(ends.b, turns);
    const double reduced = a > 0 && b > 0 ? a * b / (a + b) : a + b;
    const double omega = 2 * kPi * ends.frequency_hz;
    springs_.push_back({ends, reduced * omega * omega});
  }
}

/// Returns the energy of displaced water, lifted to the level: its weight times the depth of its
/// centroid. The derivative by a body's height is the buoyancy, and by its angle the torque.
double EnergyMeter::InWater(const std::vector<BodyState>& moving) const {
  double energy = 0;
  for (std::size_t i = 0; i < wet_shapes_.size(); ++i) {
    FloatingBody body;
    body.position = moving[i].position.cast<double>();
    body.rotation = Rotation<double>(static_cast<double>(moving[i].angle));
    for (const Water& water : waters_) {
      const Bounds bounds = BoundsOf(water);
      const AreaMoments wet = Displaced(wet_shapes_[i], nullptr, body, bounds);
      const double weight = static_cast<double>(water.density) * wet.area * -gravity_.y();
      energy += weight * (bounds.max.y() - wet.centre.y());
    }
  }
  return energy;
}

double EnergyMeter::Stretch(const Spring& spring, const std::vector<BodyState>& states) const {
  const JointEnds& ends = spring.ends;
  if (SpringOf(ends.kind) == JointSpring::kAngle) {
    const auto angle = [&](const JointEnd& end) {
      return end.moving < 0 ? 0 : double{states[static_cast<std::size_t>(end.moving)].angle};
    };
    return angle(ends.b) - angle(ends.a) - ends.angle;
  }
  const Eigen::Vector2d apart = ends.b.PointNow(states) - ends.a.PointNow(states);
  return SpringOf(ends.kind) == JointSpring::kAxis ? apart.dot(ends.a.AxisNow(states))
                                                   : apart.norm() - ends.length;
}

double EnergyMeter::Of(const std::vector<BodyState>& moving, std::int64_t tick) const {
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
    energy -= masses_[i].mass * gravity_.dot(RootFrame(state).ToWorld(masses_[i].centre));
  }
  if (springs_.empty()) return energy;
  const std::vector<BodyState> states = AllStates(moving, imposed_, tick);
  for (const Spring& spring : springs_) {
    const double stretch = Stretch(spring, states);
    energy += spring.stiffness * stretch * stretch / 2;
  }
  return energy;
}

}  // namespace seam
