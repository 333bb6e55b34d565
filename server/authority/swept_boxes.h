#pragma once
/// When two moving boxes will touch.

#include "common/sync/reach/zones.h"

namespace seam {

/// Seconds until the two, moving on as they do now, come nearer than `gap` m (and what players can
/// accelerate within that time); FLT_MAX: not within `seconds_max`. Neither recedes into the other:
/// what moves apart does not touch.
float SecondsToTouch(const MovingBox& a, const MovingBox& b, float gap, float seconds_max);

}  // namespace seam
