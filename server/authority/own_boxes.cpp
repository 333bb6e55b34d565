#include "server/authority/own_boxes.h"

namespace seam {

OwnBoxes::OwnBoxes(const AuthorityView& view, const AuthorityPlan& plan,
                   const PlayerOfPeer& players)
    : boxes_(view.boxes), begin_(view.players.size() + 1, 0) {
  std::vector<int> player_of(boxes_.size(), -1);
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const int authority = plan[static_cast<std::size_t>(boxes_[i].group)].authority;
    player_of[i] = authority > 0 ? players.At(authority) : -1;
    if (player_of[i] >= 0) ++begin_[static_cast<std::size_t>(player_of[i]) + 1];
  }
  for (std::size_t p = 0; p + 1 < begin_.size(); ++p) begin_[p + 1] += begin_[p];
  own_.resize(static_cast<std::size_t>(begin_.back()));
  std::vector<int> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t i = 0; i < player_of.size(); ++i) {
    if (player_of[i] < 0) continue;
    int& at = next[static_cast<std::size_t>(player_of[i])];
    own_[static_cast<std::size_t>(at++)] = static_cast<int>(i);
  }
  for (std::size_t p = 0; p + 1 < begin_.size(); ++p) {
    NearestBox::Sort(boxes_, begin_[p], begin_[p + 1], &own_);
  }
}

}  // namespace seam
