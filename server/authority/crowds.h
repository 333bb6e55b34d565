#pragma once
/// Crowds: large groups with many holders, such as a gas or a scattered heap, of which a peer
/// follows only the surroundings of its own mechanisms.

#include <algorithm>
#include <vector>

#include "common/sync/reach/zones.h"
#include "server/authority/group_lists.h"
#include "server/authority/plan.h"
#include "server/authority/player_of_peer.h"

namespace seam {

/// In a room that is not followed whole, a group with at least kManyHolders holders is a crowd,
/// unless packed. Nearly every member may touch every other through chains of contacts, but a
/// distant disturbance does not arrive within a round trip unless all members on the way touch. So
/// a holder follows only those members that it may meet itself, that press on its own mechanisms
/// directly or through others, or that are within kCrowdReach of these, m: as far as mode central
/// predicts (Interest::kCloseReach).
constexpr std::size_t kManyHolders = 8;
constexpr float kCrowdReach = 24;

/// True if a push propagates through the group: at least three quarters of its members press on
/// another. `touching`: by mechanism, the lowest index in its touching component.
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

/// Distance covered within ZoneSeconds (`soon`), and within kZoneKeep more (`later`), m.
struct Way {
  float soon = 0, later = 0;
  void Raise(const Way& other) {
    soon = std::max(soon, other.soon);
    later = std::max(later, other.later);
  }
};

/// Returns the distance that a box may cover within `seconds`, m; FindContactGroups uses the same.
inline float WayOf(const MovingBox& box, float seconds) {
  return box.velocity.norm() * seconds + kZoneSlack / 2 + box.acceleration * seconds * seconds / 2;
}

/// Upper bounds of the distances that boxes cover before a grant could arrive.
struct Ways {
  std::vector<Way> of;   ///< by mechanism
  std::vector<Way> own;  ///< by player: over all mechanisms that its peer is planned to have
  Way farthest;          ///< over all mechanisms
};
Ways FindWays(const AuthorityView& view, const AuthorityPlan& plan, const PlayerOfPeer& players);

/// Crowd of each mechanism, and the crowds in which each player has authority over a member.
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
  /// True if the mechanism is in a crowd of which the player has a member.
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
