#pragma once
/// What seam-swarm prints at its end: lines of "name: figures", for people and for grep.

#include <string>
#include <vector>

#include "client/swarm/swarm.h"
#include "common/record/load_page.h"

namespace seam {

/// What a server told of its rooms, in any order: when the swarm's clients began to be measured, of
/// the seconds in which they were, and at their end.
struct ServerTold {
  std::vector<RoomLoad> before, meanwhile, after;
};

/// Of a measured swarm; where nothing was told meanwhile the server was not heard.
std::string SwarmReport(const Swarm& swarm, const ServerTold& told);

/// The server's lines alone; "server: not heard ..." of nothing. p99 of all rooms' ticks of the
/// measured time, if the server counts them (its page does, the bus does not); percentiles of the
/// worst second and the worst room, CPU from the first to the last telling of each room.
std::string ServerReport(const ServerTold& told);

}  // namespace seam
