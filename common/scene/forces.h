#pragma once
/// What pushes parts besides gravity, contacts, joints and water, as a scene names it: conveyors,
/// thrust and propellers.

#include <string>

#include "common/scene/types.h"

namespace seam {

/// A surface that moves along itself while its part stays where it is.
struct Conveyor {
  float speed = 0;  ///< m/s, clockwise around the part: its top to the right
  int player = -1;  ///< whose axis the speed follows; -1: it always runs
  InputAxis axis = InputAxis::kDrive;
};

/// A propeller, seen from its side: a disc whose blades push the water that they meet.
///
///            |  blades, at radius r pitched by atan(pitch / 2 pi r)
///   at  -----+----->  along the force: where it pushes at positive turns
///            |  diameter, across
struct Screw {
  float diameter = 0;  ///< m; 0: there is none
  float pitch = 0;     ///< m, what a turn would advance it through something solid
  float turns = 0;     ///< 1/s, at full axis
  float solidity = 1;  ///< share of the disc that its blades cover
  float torque = 0;    ///< N m, the most that its shaft turns with; 0: any
};

/// A force that a part carries with it: a rocket, a propeller in air; or, with a screw, a propeller
/// in water, whose force is what the water gives.
struct Thrust {
  std::string name;  ///< unique
  PartId part = 0;
  Vec2 at{0, 0};     ///< m, in the part's frame
  Vec2 force{0, 0};  ///< N, in the part's frame; of a screw its direction, of length 1
  int player = -1;   ///< who commands it; -1: it always pushes
  InputAxis axis = InputAxis::kDrive;
  int button = -1;  ///< pushes while it is pressed, instead of following the axis
  Screw screw;
  int line = 0;  ///< in the scene file
};

}  // namespace seam
