#pragma once
/// How far joints have come apart, by their definition in the scene: what an iterative solver
/// leaves undone.

#include <vector>

#include "common/measure/joint_ends.h"

namespace seam {

class JointMeter {
 public:
  JointMeter(const Scene& scene, const Composition& composition)
      : joints_(FindJointEnds(scene, composition)), imposed_(scene, composition) {}

  /// m, >= 0: the worst of all joints. Revolute, and weld and glue where they are joints: how far
  /// the anchors are apart; wheel and prismatic: how far the anchor on `b` is off the axis through
  /// the anchor on `a`, or along it beyond the limits, and along it at all for a wheel with neither
  /// spring nor limits; distance and rope: how much longer or shorter it is than it may be, 0 for a
  /// spring without limits; gear: how far its two joints' movements are off their ratio, in rad
  /// where the first is a hinge, which is m at an arm of 1 m; pulley: how much longer or shorter
  /// the rope is; motor: 0, since it yields. `moving`: of the moving assemblies ascending by id.
  /// `tick`: where kinematic parts are. Infinite when a pose is not finite.
  double Worst(const std::vector<BodyState>& moving, std::int64_t tick = 0) const;
  /// The same of each joint, in the order of FindJointEnds.
  std::vector<double> Drifts(const std::vector<BodyState>& moving, std::int64_t tick = 0) const;

 private:
  std::vector<JointEnds> joints_;
  ImposedMotions imposed_;
};

}  // namespace seam
