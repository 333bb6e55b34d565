#pragma once
/// A set of players, for permissions.

#include <bitset>
#include <cstddef>

#include "common/base/check.h"
#include "common/base/limits.h"

namespace seam {

/// Some of a scene's players, or everyone, spectators included.
class PlayerMask {
 public:
  /// The empty set.
  constexpr PlayerMask() = default;
  static constexpr PlayerMask Everyone() {
    PlayerMask mask;
    mask.everyone_ = true;
    return mask;
  }

  /// Requires a player, 0..kPlayersMax - 1.
  void Add(int player) {
    SEAM_ASSERT(player >= 0 && player < kPlayersMax);
    players_.set(static_cast<std::size_t>(player));
  }
  /// Keeps only the members that are in `other` too.
  PlayerMask& operator&=(const PlayerMask& other) {
    if (everyone_) {
      *this = other;
    } else if (!other.everyone_) {
      players_ &= other.players_;
    }
    return *this;
  }
  /// Returns true if the player is in the set; -1 stands for a peer that does not play.
  bool Allows(int player) const {
    return everyone_ ||
           (player >= 0 && player < kPlayersMax && players_[static_cast<std::size_t>(player)]);
  }
  bool everyone() const { return everyone_; }

 private:
  std::bitset<static_cast<std::size_t>(kPlayersMax)> players_;
  bool everyone_ = false;
};

constexpr PlayerMask kEveryPlayer = PlayerMask::Everyone();
inline bool Allows(const PlayerMask& mask, int player) { return mask.Allows(player); }

}  // namespace seam
