#pragma once
/// The load report of a room, a message of the bus, and its kinds of traffic.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/codec/message_limits.h"

namespace seam {

/// Bus only, from the server, once a second: the cost of the room and the lateness of its ticks.
/// Counters run since the room was opened; times cover the ticks of the last second.
struct Load {
  std::int64_t utime = 0;
  std::int64_t session = 0, sequence = 0;
  std::int64_t tick = 0;
  std::int32_t speed_ppm = kFullSpeedPpm;  ///< speed of the room's clock, per million of real time
  std::int32_t ticks = 0;                  ///< in the last second
  std::int32_t tick_p50_us = 0, tick_p99_us = 0, tick_max_us = 0;  ///< wall time of a tick
  std::int32_t late_p50_us = 0, late_p99_us = 0, late_max_us = 0;  ///< lateness of ticks
  std::int64_t cpu_us = 0;                                         ///< spent on this room
  std::int32_t clients = 0, players = 0;
  std::int32_t bodies = 0, moving = 0, moving_held = 0;  ///< held: a client has authority
  std::int32_t islands = 0;                              ///< awake contact islands
  std::int64_t hand_overs = 0;                           ///< changes of a mechanism's authority
  std::int64_t jumps = 0;                                ///< hand-overs with a visible correction
  std::int64_t dropped_malformed = 0, dropped_stale = 0, dropped_right = 0;  ///< as in Stats
  std::int64_t dropped_implausible = 0, dropped_budget = 0;
  std::vector<std::int8_t> kind;  ///< kTraffic...
  std::vector<std::int64_t> bytes_out, bytes_in;
};
constexpr std::size_t kTrafficMax = 16;  ///< most kinds in a Load
constexpr std::int8_t kTrafficFraming = 0, kTrafficStates = 1, kTrafficInputs = 2, kTrafficRest = 3,
                      kTrafficGrants = 4, kTrafficHandOver = 5, kTrafficEdits = 6,
                      kTrafficJoining = 7, kTrafficClock = 8, kTrafficRules = 9, kTrafficOther = 10;

}  // namespace seam
