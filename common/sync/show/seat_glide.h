#pragma once
/// Makes views glide gently for players who are entering or have just left a seat. Everyone watches
/// these, and a peer that hears of the change late has metres to catch up.

#include <cstdint>
#include <vector>

#include "common/physics/world.h"
#include "common/sync/table/body_column.h"

namespace seam {

class SeatGlide {
 public:
  explicit SeatGlide(const BodyTable& table) : shown_(table, BodyRule::kSame) {}

  /// Call once a tick.
  void Look(const World& world);
  /// True if a mechanism's view is to glide gently.
  bool IsGentle(int mechanism) const;
  /// Mechanisms for which IsGentle is true.
  const std::vector<int>& gentle() const { return gentle_; }
  /// The mechanisms of all players, in a scene with seats: each may become a gentle one's part.
  const std::vector<int>& players() const { return players_; }

  /// Limits the move of a mechanism's displayed poses (by body) since the last tick: scales all of
  /// them back by one share, so that none moves further than its velocity explains plus
  /// kGentleBeside. Returns true if it changed anything; joints are then slightly open.
  bool HoldBack(const World& world, const std::vector<int>& bodies,
                std::vector<BodyState>* poses) const;
  /// Records the poses as displayed.
  void Shown(const World& world, const std::vector<int>& bodies,
             const std::vector<BodyState>& poses);

 private:
  struct ShownPose {
    std::int64_t tick = -2;  // before any tick's predecessor
    BodyState pose;
  };
  std::vector<int> ticks_;   // by player: ticks left
  std::vector<int> gentle_, players_;  // mechanisms
  BodyColumn<ShownPose> shown_;
};

}  // namespace seam
