#pragma once
/// The final report of seam-swarm: lines of "name: figures", for people and for grep.

#include <string>
#include <vector>

#include "client/swarm/swarm.h"
#include "common/record/load_page.h"

namespace seam {

/// Loads of a server's rooms, in any order: at the start of the measurement, during it, and at its
/// end.
struct ServerLoads {
  std::vector<RoomLoad> before, meanwhile, after;
};

/// Returns the report of a measured swarm; without loads during the measurement it says that the
/// server was not heard.
std::string SwarmReport(const Swarm& swarm, const ServerLoads& told);

/// Returns the server's lines alone; "server: not heard ..." if there are none. p99 is over the
/// measured ticks of all rooms, if the server counts them (its page does, the bus does not). Other
/// percentiles are those of the worst second and room. CPU is from the first to the last load of
/// each room.
std::string ServerReport(const ServerLoads& told);

}  // namespace seam
