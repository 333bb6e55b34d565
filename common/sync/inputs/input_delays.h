#pragma once
/// Input delay of a room by the tick in which an input is read. It changes in a running room where
/// the server adapts it (Policy::AdaptsInputDelay); an event says so.

#include <cstdint>
#include <utility>
#include <vector>

#include "common/codec/event.h"

namespace seam {

/// Largest delay that a server chooses, ticks. Inputs of twice as many ticks may be on their way to
/// a peer, and must fit one message. Less makes rooms on long ways wait for each tick.
constexpr int kAdaptedDelayMax = 24;
/// Returns the ticks from the event of a change to the first input with the new delay: every client
/// has heard of it by then.
constexpr std::int64_t DelayNotice(int tick_hz) { return tick_hz / 2; }

class InputDelays {
 public:
  explicit InputDelays(int ticks = 0) : changes_{{0, ticks}} {}

  /// Inputs that are read in `from_tick` or later act `ticks` later. Requires ascending ticks.
  void Change(std::int64_t from_tick, int ticks) { changes_.emplace_back(from_tick, ticks); }
  /// Takes an event; ignores other kinds, and delays beyond 0..kAdaptedDelayMax.
  void Take(const Event& event, int tick_hz);

  int At(std::int64_t read_tick) const;
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
