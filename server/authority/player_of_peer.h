#pragma once
/// Map from a peer to the player it drives, for one view.

#include <algorithm>
#include <vector>

#include "server/authority/plan.h"

namespace seam {

class PlayerOfPeer {
 public:
  explicit PlayerOfPeer(const AuthorityView& view) {
    int last = 0;
    for (const PlayerView& player : view.players) last = std::max(last, player.peer);
    players_.assign(static_cast<std::size_t>(last) + 1, -1);
    for (std::size_t p = 0; p < view.players.size(); ++p) {
      const int peer = view.players[p].peer;
      if (peer > 0) players_[static_cast<std::size_t>(peer)] = static_cast<int>(p);
    }
  }
  /// Returns -1 for the server and for a spectator. Requires a valid peer number.
  int At(int peer) const {
    const auto i = static_cast<std::size_t>(peer);
    return i < players_.size() ? players_[i] : -1;
  }

 private:
  std::vector<int> players_;  // by peer, up to the last player's
};

}  // namespace seam
