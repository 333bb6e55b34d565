#pragma once
/// What seam-swarm prints at its end: lines of "name: figures", for people and for grep.

#include <string>
#include <vector>

#include "client/swarm/swarm.h"
#include "common/record/load_page.h"

namespace seam {

/// Of a measured swarm. `loads`: what the server told of its rooms meanwhile, in any order; empty:
/// it was not heard.
std::string SwarmReport(const Swarm& swarm, const std::vector<RoomLoad>& loads);

/// The server's lines alone; "server: not heard ..." of nothing. Percentiles of the worst second
/// and the worst room, CPU from the first to the last telling of each room.
std::string ServerReport(const std::vector<RoomLoad>& loads);

}  // namespace seam
