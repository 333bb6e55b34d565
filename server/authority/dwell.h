#pragma once
/// Whether an authority is too young to change.

#include "server/authority/player_of_peer.h"

namespace seam {

/// A player's peer keeps what it has for the dwell; the server gives at once.
inline bool Dwells(const AuthorityView& view, const PlayerOfPeer& players,
                   const MechanismView& mechanism) {
  const auto ticks = static_cast<std::int64_t>(view.rules.dwell_s * view.tick_hz);
  return mechanism.held_ticks < ticks && players.At(mechanism.now.authority) >= 0;
}

}  // namespace seam
