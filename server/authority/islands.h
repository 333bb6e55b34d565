#pragma once
/// The contact islands of a view: who drives in each, who has it, what is to be known of it.

#include <cfloat>
#include <vector>

#include "server/authority/plan_ground.h"
#include "server/authority/plan_islands.h"
#include "server/authority/player_of_peer.h"

namespace seam {

/// Mechanisms that touch, directly or through others. Players are indices; -1: none.
struct Island {
  int driver = -1;        ///< the lowest player who drives something of it
  bool disputed = false;  ///< several drive
  bool awake = false;     ///< anything of it
  int members = 0;
  int rest = 0;         ///< members that nobody drives
  int rest_bodies = 0;  ///< of those
  int contacts = 0;     ///< pairs of bodies that touch
  float fastest = 0;    ///< of the rest, m/s
  int holder = -1;      ///< the player who has most bodies of the rest, the lowest of several
  float holder_gap = FLT_MAX;  ///< m to the holder's vehicles, if that is within rules.keep
  int nearest = -1;            ///< the player whose vehicle is nearest, within rules.keep
  float nearest_gap = FLT_MAX;
  int claim = -1;           ///< the player whose vehicle will touch it first
  float claim_s = FLT_MAX;  ///< in so many seconds
  bool holder_claims = false;
  bool holder_keeps = false;  ///< it would claim what sleeps if it looked kTouchKeep farther ahead

  /// Whether its rest should be one player's, although several press on it.
  bool Merges() const {
    const bool dense = rest >= kDenseCount &&
                       static_cast<float>(contacts) >= kDenseContacts * static_cast<float>(members);
    return dense || fastest < kSettles;
  }
};

class Islands {
 public:
  /// Who has what is as of now; claims and distances are for others to fill in.
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
  /// The player who drives the mechanism and is here; -1: nobody.
  int driver(int mechanism) const { return driver_[static_cast<std::size_t>(mechanism)]; }
  /// Bodies of a mechanism.
  int bodies(int mechanism) const { return bodies_[static_cast<std::size_t>(mechanism)]; }
  /// Whether the player drives something of the island.
  bool Drives(int player, const Island& island) const;
  /// The box around each mechanism that somebody drives; its group is the mechanism.
  std::vector<MovingBox> VehicleBoxes(const AuthorityView& view) const;

 private:
  void Group(const PlanGround& ground);
  void Describe(const AuthorityView& view);
  void FindHolders(const AuthorityView& view, const PlayerOfPeer& players);

  std::vector<Island> islands_;
  std::vector<int> island_, driver_, bodies_;  // by mechanism
  std::vector<int> begin_, members_;           // by island: where its members begin, and they
};

}  // namespace seam
