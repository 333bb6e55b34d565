#pragma once
/// Cost of a session: CPU time of the server and of a client, bytes, and the clients' share of the
/// work.

#include <cstdint>

#include "client/embed/cluster.h"

namespace seam {

/// Of the ticks after the first second.
struct SessionLoad {
  int players = 0;
  int bodies = 0;               ///< that move, in the scene
  double awake = 0;             ///< moving bodies awake at their authority, on average
  double stepped = 0;           ///< bodies in the server's steps, on average, displayed ones too
  double server_us = 0;         ///< CPU time a tick, network included; sockets are not
  double server_p99_us = 0;     ///< of the ticks
  double client_us = 0;         ///< CPU time a tick and client
  double to_client_kbps = 0;    ///< kB/s of UDP payload from the server, a client
  double from_client_kbps = 0;  ///< kB/s of UDP payload to the server, a client
  double held_share = 0;        ///< of the awake bodies' seconds: a client had authority
  double split_share = 0;       ///< of the clients' pairs that touch: two have authority
};

/// Runs the session to its end. Figures of CPU time are this machine's and noisy; all else is a
/// function of the configuration. Throws OperatorError as Cluster does.
SessionLoad MeasureLoad(ClusterConfig config);

}  // namespace seam
