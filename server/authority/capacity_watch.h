#pragma once
/// Estimates how many bodies each player's machine can step, from its reported load.
///
///   load   1.0 |    *                      overloaded: it gets fewer bodies
///          0.8 |- - - *- - *-*-*- - - - -  target
///              |__*__________*___________  below it, a limited machine gets more again

#include <cstdint>
#include <functional>
#include <vector>

namespace seam {

class CapacityWatch {
 public:
  /// Returns the number of bodies that the player's peer can step now; PlayerView::kUnlimited if it
  /// was never overloaded or no longer is. `load`: share of real time that it needs, below 0:
  /// unknown. `steps` returns how many bodies it has or follows now; called only if it may be
  /// overloaded. A different peer starts with no limit.
  int Look(std::size_t player, std::int64_t now_us, int peer, float load,
           const std::function<int()>& steps);

  /// Load above which a machine is overloaded.
  static constexpr float kFull = 1.0f;
  /// Target load; below 1 because replayed ticks come in bursts.
  static constexpr float kTarget = 0.8f;
  /// Delay until a change shows in the reported load, us: the client's window, the network path, a
  /// hand-over.
  static constexpr std::int64_t kSettleUs = 900000;
  /// Limits of the factor by which one call changes the capacity.
  static constexpr float kFactorMin = 0.3f, kFactorMax = 1.2f;

 private:
  struct Seen {
    int peer = -1;
    float bodies = 0;  // 0: not limited
    std::int64_t changed_us = 0;
  };
  std::vector<Seen> seen_;  // by player
};

}  // namespace seam
