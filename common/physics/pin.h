#pragma once
/// What the engine's joints hold, as geometry: for whoever moves bodies without stepping them.

#include "common/scene/types.h"

namespace seam {

/// How a body resists being moved.
struct MassPoint {
  float mass = 0;     ///< kg
  float inertia = 0;  ///< kg m^2, about the centre of mass
  Vec2 centre{0, 0};  ///< m, the centre of mass in the body's frame
};

/// One side of a pin.
struct PinEnd {
  int body = -1;      ///< index as in World; -1: anchored, or moved by the tick alone
  int assembly = -1;  ///< index into Composition::assemblies
  Vec2 point{0, 0};   ///< m, in the body's frame
};

/// A joint between two bodies. With p the way from a's point to b's in the frame of a's axis (x
/// along it), p.x() is to be within lower..upper and p.y() to be 0; where `by_distance` the length
/// of p is to be within lower..upper. A range may be without end. In each case b's angle less a's
/// is to be within angle_lower..angle_upper. A spring holds nothing, but what it acts on swings
/// about where it rests.
struct Pin {
  PinEnd a, b;
  bool by_distance = false;
  Vec2 axis{1, 0};                         ///< unit, in a's frame
  float lower = 0, upper = 0;              ///< m
  float angle_lower = 0, angle_upper = 0;  ///< rad; without end where a joint turns freely
  float swing = 0, rest = 0;               ///< of a spring that pulls p: rad/s (0: none), m
  float turn_swing = 0, turn_rest = 0;     ///< of one that turns b: rad/s (0: none), rad
};

}  // namespace seam
