#pragma once
/// Joint drift: the residual error of joints, measured by their definition in the scene. An
/// iterative solver leaves some.

#include <vector>

#include "common/measure/joint_ends.h"

namespace seam {

/// Measures the drift of a scene's joints.
class JointMeter {
 public:
  JointMeter(const Scene& scene, const Composition& composition)
      : joints_(FindJointEnds(scene, composition)), imposed_(scene, composition) {}

  /// Returns the greatest drift of all joints, m, >= 0. Revolute, and weld and glue where they are
  /// joints: distance of the anchors. Wheel and prismatic: distance of the anchor on `b` from the
  /// axis through the anchor on `a`, or along it beyond the limits; any distance along it for a
  /// wheel with neither spring nor limits. Distance and rope: excess or lack of length; 0 for a
  /// spring without limits. Gear: deviation of its two joints' movements from their ratio, in rad
  /// where the first is a hinge, which is m at an arm of 1 m. Pulley: excess or lack of rope.
  /// Motor: 0, since it yields. `moving`: states of the moving assemblies, ascending by id.
  /// `tick`: places kinematic parts. Infinite when a pose is not finite.
  double Worst(const std::vector<BodyState>& moving, std::int64_t tick = 0) const;
  /// Returns the drift of each joint, in the order of FindJointEnds.
  std::vector<double> Drifts(const std::vector<BodyState>& moving, std::int64_t tick = 0) const;

 private:
  std::vector<JointEnds> joints_;
  ImposedMotions imposed_;
};

}  // namespace seam
