#pragma once
/// The server's counters, and the lateness of its ticks.

#include <algorithm>
#include <cstdint>

#include "common/codec/messages.h"
#include "common/record/load_page.h"
#include "server/sessions/account_book.h"

namespace seam {

/// Returns the number of dropped messages, for all reasons together.
inline std::int64_t Dropped(const Stats& stats) {
  return stats.dropped_malformed + stats.dropped_stale + stats.dropped_right +
         stats.dropped_implausible + stats.dropped_budget;
}

inline DropCount DropsOf(const Stats& stats) {
  return {stats.dropped_malformed, stats.dropped_stale, stats.dropped_right,
          stats.dropped_implausible, stats.dropped_budget};
}

/// Adds to `to` what was dropped since `before`.
inline void AddDrops(const Stats& stats, const DropCount& before, DropCount* to) {
  to->malformed += stats.dropped_malformed - before.malformed;
  to->stale += stats.dropped_stale - before.stale;
  to->right += stats.dropped_right - before.right;
  to->implausible += stats.dropped_implausible - before.implausible;
  to->budget += stats.dropped_budget - before.budget;
}

struct ServerStats {
  Stats counters;                  ///< since the start
  Connections connections;         ///< since the start
  std::int64_t decoded = 0;        ///< messages, since the start
  std::int64_t jumps = 0;          ///< since the start
  std::int64_t worst_late_us = 0;  ///< latest tick since the last report
  std::int64_t discarded = 0;      ///< by the net, as last noted
  std::int64_t reported_us = -1000000000;

  bool Due(std::int64_t now_us) const { return now_us - reported_us >= 1000000; }
  void NoteLate(std::int64_t late_us) { worst_late_us = std::max(worst_late_us, late_us); }
  /// Counts datagrams that the net has discarded as malformed. `total`: since the start.
  void NoteDiscarded(std::int64_t total) {
    counters.dropped_malformed += total - discarded;
    discarded = total;
  }
  /// Returns the counters for a report, completed by the arguments; begins the next report.
  const Stats& Report(std::int64_t now_us, std::int64_t tick, std::int64_t cpu_us,
                      std::int64_t rtt_us, std::int64_t loss_ppm) {
    reported_us = now_us;
    counters.utime = now_us;
    counters.tick = tick;
    counters.cpu_us = cpu_us;
    counters.tick_late_us =
        static_cast<std::int32_t>(std::min<std::int64_t>(worst_late_us, 1 << 30));
    counters.rtt_us = static_cast<std::int32_t>(rtt_us);
    counters.loss_ppm = static_cast<std::int32_t>(loss_ppm);
    worst_late_us = 0;
    return counters;
  }
};

}  // namespace seam
