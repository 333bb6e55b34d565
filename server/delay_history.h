#pragma once
/// Input delays of a room by the tick in which an input is read, where the server adapts them
/// (Policy::AdaptsInputDelay).

#include <cstdint>
#include <utility>
#include <vector>

namespace seam {

class DelayHistory {
 public:
  explicit DelayHistory(int ticks) : changes_{{0, ticks}} {}

  /// Inputs that are read in `from_tick` or later act `ticks` later. Requires ascending ticks.
  void Change(std::int64_t from_tick, int ticks) { changes_.emplace_back(from_tick, ticks); }

  int newest() const { return changes_.back().second; }
  /// Returns the tick from which on inputs are read with the newest delay.
  std::int64_t newest_from() const { return changes_.back().first; }
  /// Returns the tick in which the input that acts in `tick` was read. Where the delay has grown,
  /// some ticks repeat the input before them: then the tick of that one.
  std::int64_t ReadTick(std::int64_t tick) const;

 private:
  std::vector<std::pair<std::int64_t, int>> changes_;  // first tick and delay, ascending
};

}  // namespace seam
