#pragma once
/// Predicts which bodies may meet soon, from boxes, speeds and times alone.
///
///      +---+  v_a                      v_b  +---+       they may meet within t when
///      | a |----->  ..... gap .....  <------| b |       gap <= |v_a - v_b| t + slack
///      +---+                                +---+       slack = kZoneSlack + (a_a + a_b) t^2 / 2

#include <functional>
#include <utility>
#include <vector>

#include "common/scene/types.h"

namespace seam {

/// A body's box and motion now.
struct MovingBox {
  Vec2 min{0, 0}, max{0, 0};  ///< m, corners of the box
  Vec2 velocity{0, 0};        ///< m/s
  float acceleration = 0;     ///< m/s^2, greatest that a player can cause
  int group = 0;              ///< the mechanism; boxes of one group are not compared
};

/// Acceleration by a player's throttle and brakes, m/s^2: tyres on a road.
constexpr float kDrivenAcceleration = 10;
/// A gap up to this counts as touching, m: resting bodies have gaps, and a tick passes.
constexpr float kZoneSlack = 0.25f;

/// A gap up to this counts as pressing, m: stacks have gaps of a centimetre or two, and states
/// heard of them are old and rounded. Bodies flying side by side are often nearer than kZoneSlack
/// and press nothing.
constexpr float kPressGap = 0.05f;

/// Returns the distance of two boxes, m; 0 where they overlap.
inline float Gap(const MovingBox& a, const MovingBox& b) {
  const Vec2 apart = (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(Vec2(0, 0));
  return apart.norm();
}

/// True if the two may touch within `seconds`.
inline bool MayMeet(const MovingBox& a, const MovingBox& b, float seconds) {
  const float slack = kZoneSlack + (a.acceleration + b.acceleration) * seconds * seconds / 2;
  return Gap(a, b) <= (a.velocity - b.velocity).norm() * seconds + slack;
}

/// Returns all pairs of groups with boxes that may touch: each pair once, the lower group first,
/// ascending. `seconds_of` (two groups) is the look-ahead for a pair, at most `seconds_max`. Uses a
/// sweep along x: n log n unless boxes crowd.
std::vector<std::pair<int, int>> MeetingGroups(const std::vector<MovingBox>& boxes,
                                               float seconds_max,
                                               const std::function<float(int, int)>& seconds_of);
/// Like the above, with one look-ahead for all pairs.
std::vector<std::pair<int, int>> MeetingGroups(const std::vector<MovingBox>& boxes, float seconds);

/// Returns the connected components of `count` groups under `pairs`: by group, the lowest group of
/// its component.
std::vector<int> Components(int count, const std::vector<std::pair<int, int>>& pairs);

}  // namespace seam
