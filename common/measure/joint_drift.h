#pragma once
/// How far joints have come apart, by their definition in the scene: what an iterative solver
/// leaves undone.

#include <vector>

#include "common/measure/joint_ends.h"

namespace seam {

class JointMeter {
 public:
  JointMeter(const Scene& scene, const Composition& composition)
      : joints_(FindJointEnds(scene, composition)) {}

  /// m, >= 0: the worst of all joints. Revolute, and weld (only where welds are joints): how far
  /// the anchors are apart; wheel: how far the anchor on `b` is off the axis through the anchor on
  /// `a`, along the axis too if it has no spring; distance: how much longer or shorter it is than
  /// its length, 0 for a spring. `moving`: of the moving assemblies ascending by id. Infinite when
  /// a pose is not finite.
  double Worst(const std::vector<BodyState>& moving) const;

 private:
  std::vector<JointEnds> joints_;
};

}  // namespace seam
