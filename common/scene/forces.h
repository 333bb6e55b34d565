#pragma once
/// Forces on parts besides gravity, contacts, joints and water, as a scene describes them:
/// conveyors, thrust and propellers.

#include <string>

#include "common/scene/types.h"

namespace seam {

/// A surface that moves along itself while its part stays in place.
struct Conveyor {
  float speed = 0;  ///< m/s, clockwise around the part: its top to the right
  int player = -1;  ///< the speed follows this player's axis; -1: always runs
  InputAxis axis = InputAxis::kDrive;
};

/// A propeller, seen from its side: a disc with blades that push the water they meet.
///
///            |  blades, at radius r pitched by atan(pitch / 2 pi r)
///   at  -----+----->  along the force: the direction of the push at positive turns
///            |  diameter, across
struct Screw {
  float diameter = 0;  ///< m; 0: there is none
  float pitch = 0;     ///< m, advance per turn through a solid medium
  float turns = 0;     ///< 1/s, at full axis
  float solidity = 1;  ///< share of the disc that the blades cover
  float torque = 0;    ///< N m, largest torque of the shaft; 0: unlimited
};

/// A force fixed to a part: a rocket, or a propeller in air; with a screw, a propeller in water,
/// whose force comes from the water.
struct Thrust {
  std::string name;  ///< unique
  PartId part = 0;
  Vec2 at{0, 0};     ///< m, in the part's frame
  Vec2 force{0, 0};  ///< N, in the part's frame; with a screw: its direction, a unit vector
  int player = -1;   ///< player that commands it; -1: always pushes
  InputAxis axis = InputAxis::kDrive;
  int button = -1;  ///< pushes while pressed, instead of following the axis
  Screw screw;
  int line = 0;  ///< line in the scene file
};

}  // namespace seam
