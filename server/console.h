#pragma once
/// Texts of seam-server for the terminal: the progress line and the missing players.

#include <cstdint>
#include <string>

#include "common/base/duration_histogram.h"
#include "server/server.h"

namespace seam {

/// Returns the names of the scene's players that are not in the room, "ann, bob"; "" if all are.
std::string MissingPlayers(const Server& server);

/// Returns the progress line, "12 of 30 s, 1 of 2 players (bob missing), rtt 53 ms, loss 1.2 %,
/// tick p99 0.24 ms, 0 drops; Ctrl-C stops". `last_tick`: the session's, 0 for none; rtt and loss
/// are the worst client's. `ticks`: wall time of all ticks so far.
std::string ServerProgress(const Server& server, std::int64_t last_tick,
                           const DurationHistogram& ticks);

}  // namespace seam
