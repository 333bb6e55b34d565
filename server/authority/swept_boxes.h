#pragma once
/// Time until two moving boxes touch.

#include "common/sync/reach/zones.h"

namespace seam {

/// Returns the seconds until the two, at constant velocity, are nearer than `gap` m (plus the
/// distance that players can gain by accelerating within `seconds_max`); FLT_MAX: not within
/// `seconds_max`. Boxes that move apart do not touch.
float SecondsToTouch(const MovingBox& a, const MovingBox& b, float gap, float seconds_max);

/// Axis along which gravity pulls, and its strength, m/s^2.
struct FallAxis {
  int axis = -1;  ///< 0: x, 1: y; -1: no gravity, or along both axes
  float pull = 0;
};
FallAxis FallAxisOf(const Vec2& gravity);

/// True if the two may come nearer than kPressGap within `seconds` on their ballistic paths: at
/// constant velocity across gravity, and along gravity anywhere within reach of a fall, rise or
/// bounce. Requires an axis. Stricter than MayMeet, which allows any change of direction: a body
/// deflected by another body or a wall is found only after that.
bool MayMeetInFall(const MovingBox& a, const MovingBox& b, const FallAxis& fall, float seconds);

}  // namespace seam
