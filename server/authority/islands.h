#pragma once
/// Contact islands of a view, with their drivers, holders and distances to the players.

#include <cfloat>
#include <vector>

#include "server/authority/plan_ground.h"
#include "server/authority/plan_islands.h"
#include "server/authority/player_of_peer.h"

namespace seam {

/// Mechanisms connected by contacts. Players are indices; -1: none.
struct Island {
  int driver = -1;        ///< lowest player that drives a member
  bool disputed = false;  ///< several players drive members
  bool awake = false;     ///< any member is awake
  int members = 0;
  int rest = 0;                ///< members without a driver
  int rest_bodies = 0;         ///< bodies of these
  int contacts = 0;            ///< pairs of bodies that touch
  float fastest = 0;           ///< speed of any body without a driver, m/s
  int holder = -1;             ///< player with most bodies of the rest; the lowest of several
  float holder_gap = FLT_MAX;  ///< m to the holder's vehicles, if within rules.keep
  int nearest = -1;            ///< player of the nearest vehicle within rules.keep
  float nearest_gap = FLT_MAX;
  int claim = -1;           ///< player that will touch the island first with its vehicle
  float claim_s = FLT_MAX;  ///< time until then
  bool holder_claims = false;
  bool holder_keeps = false;  ///< would claim it asleep if looking kTouchKeep farther ahead

  /// True if one player should have the whole rest although several press on it.
  bool Merges() const {
    const bool dense = rest >= kDenseCount &&
                       static_cast<float>(contacts) >= kDenseContacts * static_cast<float>(members);
    return dense || fastest < kSettles;
  }
};

class Islands {
 public:
  /// Fills in current holders; the caller fills in claims and distances.
  Islands(const PlanGround& ground, const PlayerOfPeer& players);

  const std::vector<Island>& all() const { return islands_; }
  Island& Of(int mechanism) {
    return islands_[static_cast<std::size_t>(island_[static_cast<std::size_t>(mechanism)])];
  }
  /// Mechanisms of the island, ascending.
  struct Members {
    const int *first, *last;
    const int* begin() const { return first; }
    const int* end() const { return last; }
  };
  Members MembersOf(int island) const {
    const auto i = static_cast<std::size_t>(island);
    return {members_.data() + begin_[i], members_.data() + begin_[i + 1]};
  }
  /// Returns the present player that drives the mechanism; -1: none.
  int driver(int mechanism) const { return driver_[static_cast<std::size_t>(mechanism)]; }
  /// Returns the number of bodies of a mechanism.
  int bodies(int mechanism) const { return bodies_[static_cast<std::size_t>(mechanism)]; }
  /// True if the player drives a member of the island.
  bool Drives(int player, const Island& island) const;
  /// Returns the bounding box of each driven mechanism; its group is the mechanism.
  std::vector<MovingBox> VehicleBoxes(const AuthorityView& view) const;

 private:
  void Group(const PlanGround& ground);
  void Describe(const AuthorityView& view);
  void FindHolders(const AuthorityView& view, const PlayerOfPeer& players);

  std::vector<Island> islands_;
  std::vector<int> island_, driver_, bodies_;  // by mechanism
  std::vector<int> begin_, members_;           // by island: start of its members, and the members
};

}  // namespace seam
