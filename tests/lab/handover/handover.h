#pragma once
/// How long it takes from the server's wish that a peer has a mechanism until that peer believes to
/// have it, what the change does to the bodies, and what it costs to tell of it.

#include <cstdint>

#include "tests/lab/cluster.h"

namespace seam {

/// Of a session after its first second. Watched at every virtual instant.
struct HandOvers {
  int clients = 0;
  int mechanisms = 0;
  double per_s = 0;          ///< changes of authority that were wished for and done
  double dropped_per_s = 0;  ///< wishes that the plan took back, or changed, before they were done
  double p50_ms = 0, p99_ms = 0, max_ms = 0;  ///< from the wish to the authority
  double gap_p95_m = 0, gap_p95_mps = 0;      ///< successor against predecessor at the same tick
  std::int64_t compared = 0;                  ///< bodies of which there is a gap
  double none_share = 0;                      ///< of mechanism-ticks: nobody believed to have it
  std::int64_t unsimulated = 0;               ///< mechanism-ticks in which nobody simulated it
  std::int64_t several = 0;   ///< mechanism-instants in which two believed to have it
  double grants_kbps = 0;     ///< kB/s of grants that arrive at a client
  double to_client_kbps = 0;  ///< kB/s of UDP payload that arrives at a client
};

/// Runs the session to its end. A function of the configuration. Throws OperatorError as Cluster
/// does.
HandOvers MeasureHandOvers(ClusterConfig config);

}  // namespace seam
