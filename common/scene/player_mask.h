#pragma once
/// A set of players, as permissions name it.

#include <bitset>
#include <cstddef>

#include "common/base/check.h"
#include "common/base/limits.h"

namespace seam {

/// Some of a scene's players, or everybody: who does not play at all, too.
class PlayerMask {
 public:
  /// Nobody.
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
  /// Leaves those that are in `other`, too.
  PlayerMask& operator&=(const PlayerMask& other) {
    if (everyone_) {
      *this = other;
    } else if (!other.everyone_) {
      players_ &= other.players_;
    }
    return *this;
  }
  /// Whether the player is in it; -1 stands for who does not play.
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
