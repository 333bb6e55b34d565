#pragma once
/// Remembers for a second which mechanisms were near each other, for an audit of that time.

#include <algorithm>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "common/sync/replica.h"

namespace seam {

class Surroundings {
 public:
  /// `replica` must outlive this.
  explicit Surroundings(const Replica& replica);

  /// Call after each tick. In each kEvery-th, finds the mechanisms near these.
  void AfterTick(const std::vector<int>& mechanisms);
  /// Calls `visit(other)` for each mechanism that was near this one between the ticks, some more
  /// than once. Returns false if that is not known.
  template <class Visit>
  bool EachNear(int mechanism, std::int64_t from, std::int64_t to, const Visit& visit) const {
    if (looks_.empty() || looks_.front().tick > from || looks_.back().tick < to) return false;
    for (const Look& look : looks_) {
      if (look.tick < from - kEvery || look.tick > to + kEvery) continue;
      auto pair =
          std::lower_bound(look.near.begin(), look.near.end(), std::make_pair(mechanism, -1));
      for (; pair != look.near.end() && pair->first == mechanism; ++pair) visit(pair->second);
    }
    return true;
  }

  /// Ticks between two looks.
  static constexpr std::int64_t kEvery = 6;

 private:
  void FindLarge();

  struct Look {
    std::int64_t tick = 0;
    std::vector<std::pair<int, int>> near;  // of mechanisms, each both ways, ascending
  };

  const Replica& replica_;
  std::deque<Look> looks_;
  std::vector<char> large_;  // rebuilt at edits, by body: looked at wherever it is
  EditHook forget_;
};

}  // namespace seam
