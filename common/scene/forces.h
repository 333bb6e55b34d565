#pragma once
/// What pushes parts besides gravity, contacts, joints and water, as a scene names it: conveyors
/// and thrust.

#include <string>

#include "common/scene/types.h"

namespace seam {

/// A surface that moves along itself while its part stays where it is.
struct Conveyor {
  float speed = 0;  ///< m/s, clockwise around the part: its top to the right
  int player = -1;  ///< whose axis the speed follows; -1: it always runs
  InputAxis axis = InputAxis::kDrive;
};

/// A force that a part carries with it: a rocket, a propeller in air.
struct Thrust {
  std::string name;  ///< unique
  PartId part = 0;
  Vec2 at{0, 0};     ///< m, in the part's frame
  Vec2 force{0, 0};  ///< N, in the part's frame
  int player = -1;   ///< who commands it; -1: it always pushes
  InputAxis axis = InputAxis::kDrive;
  int button = -1;  ///< pushes while it is pressed, instead of following the axis
  int line = 0;     ///< in the scene file
};

}  // namespace seam
