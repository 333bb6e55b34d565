#pragma once
/// The constraints of the engine's joints as geometry, for code that moves bodies without stepping.

#include "common/scene/types.h"

namespace seam {

/// Inertial properties of a body.
struct MassPoint {
  float mass = 0;     ///< kg
  float inertia = 0;  ///< kg m^2, about the centre of mass
  Vec2 centre{0, 0};  ///< m, the centre of mass in the body's frame
};

/// One side of a pin.
struct PinEnd {
  int body = -1;      ///< index as in World; -1: anchored or kinematic
  int assembly = -1;  ///< index into Composition::assemblies
  Vec2 point{0, 0};   ///< m, in the body's frame
};

/// A joint between two bodies. Let p be the vector from a's point to b's, in the frame of a's axis
/// (x along it). The joint keeps p.x() within lower..upper and p.y() at 0; or, if `by_distance`,
/// the length of p within lower..upper. A range may be unbounded. In each case b's angle less a's
/// is kept within angle_lower..angle_upper. A spring constrains nothing, but its body oscillates
/// about a rest position.
struct Pin {
  PinEnd a, b;
  bool by_distance = false;
  Vec2 axis{1, 0};                         ///< unit, in a's frame
  float lower = 0, upper = 0;              ///< m
  float angle_lower = 0, angle_upper = 0;  ///< rad; unbounded where a joint turns freely
  float swing = 0, rest = 0;               ///< of a spring that pulls p: rad/s (0: none), m
  float turn_swing = 0, turn_rest = 0;     ///< of a spring that turns b: rad/s (0: none), rad
};

}  // namespace seam
