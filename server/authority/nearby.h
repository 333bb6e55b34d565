#pragma once
/// What finds the boxes of a view that are near each other, made once for a whole plan.

#include "server/authority/box_grid.h"
#include "server/authority/box_sweep.h"
#include "server/authority/plan.h"

namespace seam {

struct Nearby {
  explicit Nearby(const AuthorityView& view)
      : seconds(kZoneKeep + ZoneSeconds(LongestWay(view), LongestWay(view))),
        grid(view.boxes),
        meeting(view.boxes, [this](const MovingBox& box) {
          return box.velocity.norm() * seconds + kZoneSlack / 2 +
                 box.acceleration * seconds * seconds / 2;
        }) {}

  /// One way, of the farthest player, s.
  static float LongestWay(const AuthorityView& view) {
    float longest = 0;
    for (const PlayerView& player : view.players) longest = std::max(longest, player.one_way_s);
    return longest;
  }

  const float seconds;  ///< the farthest that any pair is looked ahead
  const BoxGrid grid;
  const BoxSweep meeting;  ///< each box grown by the way that it can make in that time: all pairs
                           ///< that touch or may meet
};

}  // namespace seam
