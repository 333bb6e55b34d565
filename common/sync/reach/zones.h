#pragma once
/// Who may meet whom soon: a function of boxes, speeds and times alone.
///
///      +---+  v_a                      v_b  +---+       they may meet within t when
///      | a |----->  ..... gap .....  <------| b |       gap <= |v_a - v_b| t + slack
///      +---+                                +---+       slack = kZoneSlack + (a_a + a_b) t^2 / 2

#include <functional>
#include <utility>
#include <vector>

#include "common/scene/types.h"

namespace seam {

/// A body as it lies and moves now.
struct MovingBox {
  Vec2 min{0, 0}, max{0, 0};  ///< m, corners of the box around it
  Vec2 velocity{0, 0};        ///< m/s
  float acceleration = 0;     ///< m/s^2, that a player can give it
  int group = 0;              ///< boxes of one group are not compared: a mechanism's
};

/// What a player's throttle and brakes do, m/s^2: tyres on a road.
constexpr float kDrivenAcceleration = 10;
/// What is this near counts as touching, m: resting things have gaps, and a tick goes by.
constexpr float kZoneSlack = 0.25f;

/// What is this near presses, m: stacks have gaps of a centimetre or two, and what is heard of them
/// is old and rounded. What flies side by side is often nearer than kZoneSlack and presses nothing.
constexpr float kPressGap = 0.05f;

/// Distance of two boxes, m; 0 where they overlap.
inline float Gap(const MovingBox& a, const MovingBox& b) {
  const Vec2 apart = (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(Vec2(0, 0));
  return apart.norm();
}

/// Whether the two may touch within `seconds`.
inline bool MayMeet(const MovingBox& a, const MovingBox& b, float seconds) {
  const float slack = kZoneSlack + (a.acceleration + b.acceleration) * seconds * seconds / 2;
  return Gap(a, b) <= (a.velocity - b.velocity).norm() * seconds + slack;
}

/// All pairs of groups of which a box of each may touch, each once, the lower first, ascending.
/// `seconds_of` (two groups) is how far ahead to look for that pair, at most `seconds_max`. Found
/// by a sweep along x: n log n for what does not crowd.
std::vector<std::pair<int, int>> MeetingGroups(const std::vector<MovingBox>& boxes,
                                               float seconds_max,
                                               const std::function<float(int, int)>& seconds_of);
/// The same for all pairs alike.
std::vector<std::pair<int, int>> MeetingGroups(const std::vector<MovingBox>& boxes, float seconds);

/// The connected components that pairs make of `count` groups: by group, the lowest of its own.
std::vector<int> Components(int count, const std::vector<std::pair<int, int>>& pairs);

}  // namespace seam
