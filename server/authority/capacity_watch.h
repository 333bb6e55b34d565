#pragma once
/// How many bodies each player's machine can step, from how busy it says it is.
///
///   load   1.0 |    *                      its machine needs all of its time: it gets less
///          0.8 |- - - *- - *-*-*- - - - -  what is aimed at
///              |__*__________*___________  below it, one that had too much gets more again

#include <cstdint>
#include <functional>
#include <vector>

namespace seam {

class CapacityWatch {
 public:
  /// What the player's peer can step now, bodies; PlayerView::kUnlimited while it was never too
  /// busy, or is not any more. `load`: share of its time that it needs, below 0: not known.
  /// `steps`: bodies that it has or follows now, asked only when it may be too busy. Another peer
  /// begins anew.
  int Look(std::size_t player, std::int64_t now_us, int peer, float load,
           const std::function<int()>& steps);

  /// Above this it is too busy.
  static constexpr float kFull = 1.0f;
  /// Aimed at: what is stepped again comes in bursts.
  static constexpr float kTarget = 0.8f;
  /// A change shows in what is said after this: the client's window, the way, a hand-over. us
  static constexpr std::int64_t kSettleUs = 900000;
  /// Most that one look may take or give, as a factor.
  static constexpr float kLeast = 0.3f, kMost = 1.2f;

 private:
  struct Seen {
    int peer = -1;
    float bodies = 0;  // 0: not limited
    std::int64_t changed_us = 0;
  };
  std::vector<Seen> seen_;  // by player
};

}  // namespace seam
