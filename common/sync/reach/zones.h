#pragma once
/// Who may meet whom soon: a function of boxes, speeds and times alone.
///
///      +---+  v_a                      v_b  +---+       they may meet within t when
///      | a |----->  ..... gap .....  <------| b |       gap <= |v_a - v_b| t + slack(t)
///      +---+                                +---+

#include <utility>
#include <vector>

#include "common/scene/types.h"

namespace seam {

/// A body as it lies and moves now.
struct MovingBox {
  Vec2 min{0, 0}, max{0, 0};  ///< m, corners of the box around it
  Vec2 velocity{0, 0};        ///< m/s
  int group = 0;              ///< boxes of one group are not compared: a mechanism's
};

/// Distance of two boxes, m; 0 where they overlap.
float Gap(const MovingBox& a, const MovingBox& b);

/// What velocities alone do not tell, m: kZoneSlack, and what an acceleration of kZoneAcceleration
/// on either side makes of it within `seconds`.
float ZoneSlack(float seconds);
constexpr float kZoneSlack = 0.25f;         ///< m
constexpr float kZoneAcceleration = 10.0f;  ///< m/s^2: brakes, throttle, gravity

/// Whether the two may touch within `seconds`.
bool MayMeet(const MovingBox& a, const MovingBox& b, float seconds);

/// All pairs of groups of which a box of each may touch within `seconds`, each once, the lower
/// first, ascending. Found by a sweep along x: n log n for what does not crowd.
std::vector<std::pair<int, int>> MeetingGroups(const std::vector<MovingBox>& boxes, float seconds);

/// The connected components that pairs make of `count` groups: by group, the lowest of its own.
std::vector<int> Components(int count, const std::vector<std::pair<int, int>>& pairs);

}  // namespace seam
