#pragma once
/// What seam-server says to the person who started it: the line that renews itself, who is missing,
/// and the table at the end.

#include <cstdint>
#include <string>
#include <vector>

#include "server/server.h"
#include "server/tick_times.h"

namespace seam {

/// Names of the scene's players who are not in the room, "ann, bob"; "" when all are.
std::string MissingPlayers(const Server& server);

/// "12 of 30 s, 1 of 2 players (bob missing), rtt 53 ms, loss 1.2 %, tick p99 0.24 ms, 0 drops;
/// Ctrl-C stops". `last_tick`: the session's, 0 for none; rtt and loss are the worst client's.
std::string ServerProgress(const Server& server, std::int64_t last_tick, const TickTimes& ticks);

/// A line for each client that was ready in the room, under a line that names the columns; ""
/// without one. Each line ends with a line end.
std::string SessionSummary(const std::vector<ClientAccount>& accounts);

}  // namespace seam
