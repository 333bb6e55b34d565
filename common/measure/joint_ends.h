#pragma once
/// The two points that a joint holds together, as its assemblies carry them.

#include <array>

#include "common/measure/pose.h"
#include "common/stages/kinematic.h"

namespace seam {

/// One end of a joint.
struct JointEnd {
  int assembly = -1;            ///< index into the composition's
  int moving = -1;              ///< index into AllStates; -1: anchored
  Eigen::Vector2d point{0, 0};  ///< m, in the root's frame; in the world if anchored
  Eigen::Vector2d axis{0, 1};   ///< unit, likewise

  Eigen::Vector2d PointNow(const std::vector<BodyState>& states) const {
    return moving < 0 ? point : RootFrame(states[static_cast<std::size_t>(moving)]).ToWorld(point);
  }
  Eigen::Vector2d AxisNow(const std::vector<BodyState>& states) const {
    return moving < 0 ? axis : RootFrame(states[static_cast<std::size_t>(moving)]).rotation(axis);
  }
};

/// A joint that the simulation has: not a weld within one body.
struct JointEnds {
  JointKind kind = JointKind::kRevolute;
  JointEnd a, b;
  double length = 0;        ///< m, of a distance joint or rope
  double frequency_hz = 0;  ///< of a spring; 0: rigid
  double angle = 0;         ///< rad, of b against a at tick 0
  bool limited = false;
  double lower = 0, upper = 0;               ///< m along a wheel's or prismatic's axis; m of length
  double turn = 0;                           ///< rad, of `angle` what is no turning of the joint
  double ratio = 1;                          ///< of a gear or pulley
  std::array<std::size_t, 2> coupled{0, 0};  ///< gear: which of the list it couples
  Eigen::Vector2d ground_a{0, 0}, ground_b{0, 0};  ///< m, of a pulley, in the world
};

/// The moving states, then those of the parts that move by the tick alone (ImposedMotions).
std::vector<BodyState> AllStates(const std::vector<BodyState>& moving,
                                 const ImposedMotions& imposed, std::int64_t tick);

/// All of them, in the scene's order.
std::vector<JointEnds> FindJointEnds(const Scene& scene, const Composition& composition);

}  // namespace seam
