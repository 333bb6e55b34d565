#pragma once
/// When two moving boxes will touch.

#include "common/sync/reach/zones.h"

namespace seam {

/// Seconds until the two, moving on as they do now, come nearer than `gap` m (and what players can
/// accelerate within that time); FLT_MAX: not within `seconds_max`. Neither recedes into the other:
/// what moves apart does not touch.
float SecondsToTouch(const MovingBox& a, const MovingBox& b, float gap, float seconds_max);

/// The axis along which gravity pulls, and by how much, m/s^2.
struct FallAxis {
  int axis = -1;  ///< 0: x, 1: y; -1: none, or neither
  float pull = 0;
};
FallAxis FallAxisOf(const Vec2& gravity);

/// Whether the two may come nearer than kPressGap within `seconds`, on the ways on which they are:
/// across gravity each goes on as it does, along it anywhere where it can fall, rise and bounce to
/// in the meantime. Requires an axis. Finer than MayMeet, which has them turn anywhere: what is
/// struck on the way by something else, or comes back from a wall, is seen when it does.
bool MayMeetOnTheirWays(const MovingBox& a, const MovingBox& b, const FallAxis& fall,
                        float seconds);

}  // namespace seam
