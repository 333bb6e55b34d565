#pragma once
/// Measures changes of authority: the time from the server's plan to give a mechanism to a peer
/// until that peer has it, the jumps of the bodies, and the bytes of the grants.

#include <cstdint>

#include "client/embed/cluster.h"

namespace seam {

/// Figures of a session after its first second. Measured at every virtual instant.
struct HandOvers {
  int clients = 0;
  int mechanisms = 0;
  double per_s = 0;          ///< changes of authority that were planned and done
  double dropped_per_s = 0;  ///< planned changes that the plan took back, or changed, before
  double p50_ms = 0, p99_ms = 0, max_ms = 0;  ///< latency, from the plan to the authority
  double gap_p95_m = 0, gap_p95_mps = 0;      ///< successor against predecessor at the same tick
  std::int64_t compared = 0;                  ///< bodies with a measured gap
  double none_share = 0;                      ///< share of mechanism-ticks without a holder
  std::int64_t unsimulated = 0;               ///< mechanism-ticks in which nobody simulated it
  std::int64_t several = 0;   ///< mechanism-instants in which two believed to have it
  double grants_kbps = 0;     ///< kB/s of grants that arrive at a client
  double to_client_kbps = 0;  ///< kB/s of UDP payload that arrives at a client
};

/// Runs the session to its end. A function of the configuration. Throws OperatorError as Cluster
/// does.
HandOvers MeasureHandOvers(ClusterConfig config);

}  // namespace seam
