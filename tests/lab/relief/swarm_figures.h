#pragma once
/// The numbers in seam-swarm's output.

#include <string>

namespace seam {

struct SwarmFigures {
  std::string failed;                       ///< why there are none; set by the caller
  double server_cpu = 0;                    ///< % of a core
  double tick_p99_ms = 0, late_p99_ms = 0;  ///< of the server
  double slowest_clock = 0;                 ///< of its rooms, %
  double held = 0, moving = 0;              ///< % that clients hold of so many bodies that move
  double client_us = 0;                     ///< CPU time of a client's tick
  double swarm_cpu = 0;                     ///< % of a core
  double client_late_ms = 0;                ///< p99
  double rejoins = 0;
  double kbps = 0;  ///< kB/s to a client
};

/// Of a report with the server's figures in it. Throws OperatorError when one is missing.
SwarmFigures ReadSwarm(const std::string& report);

}  // namespace seam
