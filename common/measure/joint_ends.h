#pragma once
/// The two anchor points of each joint, in the frames of its assemblies.

#include <array>

#include "common/measure/pose.h"
#include "common/stages/kinematic.h"

namespace seam {

/// One end of a joint.
struct JointEnd {
  int assembly = -1;            ///< index into the composition's assemblies
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

/// A joint of the simulation; a rigid joint within one body is none.
struct JointEnds {
  JointKind kind = JointKind::kRevolute;
  JointEnd a, b;
  double length = 0;        ///< distance joint or rope: m
  double frequency_hz = 0;  ///< spring frequency; 0: rigid
  double angle = 0;         ///< rad, angle of b less that of a at tick 0
  bool limited = false;
  double lower = 0, upper = 0;               ///< m along a wheel's or prismatic's axis; m of length
  double turn = 0;                           ///< rad, part of `angle` that is due to bonds
  double ratio = 1;                          ///< gear, pulley
  std::array<std::size_t, 2> coupled{0, 0};  ///< gear: indices of its two joints in the list
  Eigen::Vector2d ground_a{0, 0}, ground_b{0, 0};  ///< pulley: m, in the world
};

/// Returns `moving` followed by the states of the kinematic parts at `tick` (ImposedMotions).
std::vector<BodyState> AllStates(const std::vector<BodyState>& moving,
                                 const ImposedMotions& imposed, std::int64_t tick);

/// Returns the joints of the simulation, in the scene's order.
std::vector<JointEnds> FindJointEnds(const Scene& scene, const Composition& composition);

}  // namespace seam
