#pragma once
/// Chooses a room's input delay from the ways of its players' inputs to the server: enough for 99 %
/// of the inputs to reach every other player in time.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace seam {

class DelayChooser {
 public:
  DelayChooser(int tick_hz, std::size_t players) : tick_hz_(tick_hz), ways_(players) {}

  /// Notes the time from the reading of a player's input to its arrival, us.
  void Note(std::size_t player, std::int64_t way_us);
  /// Forgets a player that has left.
  void Forget(std::size_t player) { ways_[player] = {}; }
  void ForgetAll() { ways_.assign(ways_.size(), {}); }
  /// Returns the delay that would have been enough, ticks: the ways of the two farthest players in
  /// a row, since the way from the server to a player is as long as that to it. nullopt until
  /// enough inputs came.
  std::optional<int> Needed() const;
  /// Returns the delay to take instead of `now`; nullopt to keep it. It grows at once, and shrinks
  /// only by two ticks or more, so that it does not go up and down.
  std::optional<int> Choose(int now) const;

  /// Inputs of a player that count, the newest; and the least to judge by.
  static constexpr std::size_t kWaysMax = 300, kWaysMin = 60;

 private:
  struct Ways {
    std::vector<std::int64_t> us;  // a ring
    std::size_t next = 0;
  };
  const int tick_hz_;
  std::vector<Ways> ways_;  // by player
};

}  // namespace seam
