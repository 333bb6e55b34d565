#include "server/authority/swept_boxes.h"

#include <algorithm>
#include <cfloat>

namespace seam {

float SecondsToTouch(const MovingBox& a, const MovingBox& b, float gap, float seconds_max) {
  const float slack = gap + (a.acceleration + b.acceleration) * seconds_max * seconds_max / 2;
  const Vec2 velocity = a.velocity - b.velocity;
  // The times in which a, seen from b, is over b along each axis; at the end along both.
  float enter = 0, leave = seconds_max;
  for (int axis = 0; axis < 2; ++axis) {
    const float low = b.min[axis] - slack - a.max[axis];   // a has to move farther than this
    const float high = b.max[axis] + slack - a.min[axis];  // and no farther than this
    const float v = velocity[axis];
    if (v == 0) {
      if (low > 0 || high < 0) return FLT_MAX;
      continue;
    }
    enter = std::max(enter, std::min(low / v, high / v));
    leave = std::min(leave, std::max(low / v, high / v));
  }
  return enter <= leave ? enter : FLT_MAX;
}

}  // namespace seam
