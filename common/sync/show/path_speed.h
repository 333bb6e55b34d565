#pragma once
/// Motion of displayed bodies along their paths, and the limits of their dead reckoning.

#include "common/scene/types.h"

namespace seam {

/// Longest extrapolation of a displayed body, s. The server sends its state twice a second and
/// resends lost ones; a peer that hears nothing for longer has lost its connection for a moment,
/// and a body that stopped would jump afterwards.
constexpr float kReckonShownMax = 2.0f;

/// Ticks between two updates of the path of a body that is not present; it goes straight on in
/// between.
constexpr int kShownEvery = 6;

/// Motion of a body along its path: velocity of its origin, m/s, and spin, rad/s.
struct PathSpeed {
  Vec2 velocity{0, 0};
  float spin = 0;
};

}  // namespace seam
