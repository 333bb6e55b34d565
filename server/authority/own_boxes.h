#pragma once
/// Boxes of the mechanisms that each player's peer is planned to have.

#include <algorithm>
#include <vector>

#include "server/authority/nearest_box.h"
#include "server/authority/plan.h"
#include "server/authority/player_of_peer.h"

namespace seam {

class OwnBoxes {
 public:
  /// `view` must outlive this object.
  OwnBoxes(const AuthorityView& view, const AuthorityPlan& plan, const PlayerOfPeer& players);

  int CountOf(std::size_t player) const { return begin_[player + 1] - begin_[player]; }

  /// Returns all boxes of a player.
  NearestBox Of(std::size_t player) const {
    return {boxes_, own_, begin_[player], begin_[player + 1]};
  }

  /// Calls `visit` (a NearestBox) for each run of boxes with gaps of at most `apart` m along x: a
  /// player's bodies may be scattered over the room.
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
  std::vector<int> begin_;  // by player: start of its boxes in own_
  std::vector<int> own_;    // indices of boxes, per player in the order of NearestBox::Sort
};

}  // namespace seam
