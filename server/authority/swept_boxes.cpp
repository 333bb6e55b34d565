#include "server/authority/swept_boxes.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace seam {

float SecondsToTouch(const MovingBox& a, const MovingBox& b, float gap, float seconds_max) {
  const float slack = gap + (a.acceleration + b.acceleration) * seconds_max * seconds_max / 2;
  const Vec2 velocity = a.velocity - b.velocity;
  // The time interval in which a overlaps b along each axis; their intersection is a contact.
  float enter = 0, leave = seconds_max;
  for (int axis = 0; axis < 2; ++axis) {
    const float low = b.min[axis] - slack - a.max[axis];   // least displacement of a relative to b
    const float high = b.max[axis] + slack - a.min[axis];  // greatest displacement
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

FallAxis FallAxisOf(const Vec2& gravity) {
  if (gravity.x() == 0 && gravity.y() != 0) return {1, std::fabs(gravity.y())};
  if (gravity.y() == 0 && gravity.x() != 0) return {0, std::fabs(gravity.x())};
  return {};
}

bool MayMeetInFall(const MovingBox& a, const MovingBox& b, const FallAxis& fall, float seconds) {
  const float slack = kPressGap + (a.acceleration + b.acceleration) * seconds * seconds / 2;
  const int across = 1 - fall.axis, along = fall.axis;
  const float low = b.min[across] - slack - a.max[across];
  const float high = b.max[across] + slack - a.min[across];
  const float v = a.velocity[across] - b.velocity[across];
  float enter = 0, leave = seconds;  // while they overlap across gravity
  if (v == 0) {
    if (low > 0 || high < 0) return false;
  } else {
    enter = std::max(enter, std::min(low / v, high / v));
    leave = std::min(leave, std::max(low / v, high / v));
    if (enter > leave) return false;
  }
  const float apart = std::max(a.min[along] - b.max[along], b.min[along] - a.max[along]);
  const float speeds = std::fabs(a.velocity[along]) + std::fabs(b.velocity[along]);
  return apart <= speeds * leave + fall.pull * leave * leave + slack;
}

}  // namespace seam
