#pragma once
/// Which player of a view a peer plays.

#include <vector>

#include "server/authority/plan.h"

namespace seam {

class PlayerOfPeer {
 public:
  explicit PlayerOfPeer(const AuthorityView& view)
      : players_(static_cast<std::size_t>(kPeersMax), -1) {
    for (std::size_t p = 0; p < view.players.size(); ++p) {
      const int peer = view.players[p].peer;
      if (peer > 0) players_[static_cast<std::size_t>(peer)] = static_cast<int>(p);
    }
  }
  /// -1: the server, or a peer that plays nobody. Requires a peer's number.
  int At(int peer) const { return players_[static_cast<std::size_t>(peer)]; }

 private:
  std::vector<int> players_;  // by peer
};

}  // namespace seam
