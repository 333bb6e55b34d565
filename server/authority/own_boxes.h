#pragma once
/// The boxes of what each player's peer is planned to have.

#include <algorithm>
#include <vector>

#include "server/authority/nearest_box.h"
#include "server/authority/plan.h"
#include "server/authority/player_of_peer.h"

namespace seam {

class OwnBoxes {
 public:
  /// The view must outlive this.
  OwnBoxes(const AuthorityView& view, const AuthorityPlan& plan, const PlayerOfPeer& players);

  int CountOf(std::size_t player) const { return begin_[player + 1] - begin_[player]; }

  /// All of them.
  NearestBox Of(std::size_t player) const {
    return {boxes_, own_, begin_[player], begin_[player + 1]};
  }

  /// Calls `visit` (a NearestBox) for those together along x that lie no more than `apart` behind
  /// each other, m: what a player has may be strewn over the room.
  template <class Visit>
  void EachRun(std::size_t player, float apart, const Visit& visit) const {
    const int end = begin_[player + 1];
    for (int begin = begin_[player], k = begin; begin < end; begin = k) {
      for (float right = At(k).max.x(); k < end && At(k).min.x() - right <= apart; ++k) {
        right = std::max(right, At(k).max.x());
      }
      visit(NearestBox(boxes_, own_, begin, k));
    }
  }

 private:
  const MovingBox& At(int k) const {
    return boxes_[static_cast<std::size_t>(own_[static_cast<std::size_t>(k)])];
  }

  const std::vector<MovingBox>& boxes_;
  std::vector<int> begin_;  // by player: where its boxes begin in own_
  std::vector<int> own_;    // indices of the boxes, of each player as NearestBox sorts them
};

}  // namespace seam
