#pragma once
/// Minimum time that an authority lasts.

#include "server/authority/player_of_peer.h"

namespace seam {

/// True if a player's peer has had the mechanism for less than the dwell time. The server's
/// authority has no minimum.
inline bool Dwells(const AuthorityView& view, const PlayerOfPeer& players,
                   const MechanismView& mechanism) {
  const auto ticks = static_cast<std::int64_t>(view.rules.dwell_s * view.tick_hz);
  return mechanism.held_ticks < ticks && players.At(mechanism.now.authority) >= 0;
}

}  // namespace seam
