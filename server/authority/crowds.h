#pragma once
/// Groups in which nearly everything may touch everything, through others: a gas, a heap of many.

#include <algorithm>
#include <vector>

#include "common/sync/reach/zones.h"
#include "server/authority/group_lists.h"
#include "server/authority/plan.h"
#include "server/authority/player_of_peer.h"

namespace seam {

/// In a room that is not followed whole, a group of so many holders is a crowd, unless it is
/// packed: nearly everything may touch everything through others. What is done far away does not
/// arrive within a round trip, unless all touches on the way, so of a crowd a holder follows what
/// it may meet itself, what presses on its own, directly or through others, and what is within
/// kCrowdReach of its own, m: as far as mode central predicts (Interest::kCloseReach).
constexpr std::size_t kManyHolders = 8;
constexpr float kCrowdReach = 24;

/// A heap in which a push goes through: three quarters of its members and more press on another.
/// `touching`: by mechanism, the lowest of what it presses on, directly or not.
inline bool IsPacked(const std::vector<int>& touching, const GroupLists::Members& group) {
  std::vector<int> names;
  for (const int m : group) names.push_back(touching[static_cast<std::size_t>(m)]);
  std::sort(names.begin(), names.end());
  std::size_t alone = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool before = i > 0 && names[i - 1] == names[i];
    const bool after = i + 1 < names.size() && names[i + 1] == names[i];
    if (!before && !after) ++alone;
  }
  return 4 * alone <= names.size();
}

/// How far something gets within ZoneSeconds, and kZoneKeep later, m.
struct Way {
  float soon = 0, later = 0;
  void Raise(const Way& other) {
    soon = std::max(soon, other.soon);
    later = std::max(later, other.later);
  }
};

/// As FindContactGroups takes it.
inline float WayOf(const MovingBox& box, float seconds) {
  return box.velocity.norm() * seconds + kZoneSlack / 2 + box.acceleration * seconds * seconds / 2;
}

/// How far the boxes get before a grant could tell, at most.
struct Ways {
  std::vector<Way> of;   ///< by mechanism
  std::vector<Way> own;  ///< by player: of what its peer is planned to have
  Way farthest;          ///< of any
};
Ways FindWays(const AuthorityView& view, const AuthorityPlan& plan, const PlayerOfPeer& players);

/// What is in which crowd, and which players have something in it.
class Crowds {
 public:
  Crowds(std::size_t mechanisms, std::size_t players) : of_(mechanisms, -1), has_(players) {}

  void Note(const GroupLists& groups, std::size_t group, const std::vector<std::size_t>& holders) {
    for (const int m : groups.Of(group)) of_[static_cast<std::size_t>(m)] = count_;
    for (const std::size_t player : holders) has_[player].push_back(count_);
    ++count_;
  }
  bool any() const { return count_ > 0; }
  bool Any(std::size_t player) const { return !has_[player].empty(); }
  /// Whether the mechanism is in a crowd in which the player has something.
  bool Has(std::size_t player, int m) const {
    const int crowd = of_[static_cast<std::size_t>(m)];
    return crowd >= 0 &&
           std::find(has_[player].begin(), has_[player].end(), crowd) != has_[player].end();
  }

 private:
  std::vector<int> of_;                // by mechanism: its crowd, or -1
  std::vector<std::vector<int>> has_;  // by player: crowds
  int count_ = 0;
};

}  // namespace seam
