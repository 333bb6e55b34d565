#pragma once
/// One session in which all clients are honest, and what the server doubts of it.

#include <cstdint>
#include <functional>
#include <vector>

#include "client/embed/cluster.h"

namespace seam {

struct HonestOutcome {
  std::int64_t judged = 0;   ///< states of clients
  std::int64_t by_copy = 0;  ///< of them, those compared with the server's copy of the same tick
  std::int64_t doubted = 0;  ///< of them, believed or not
  std::int64_t refused = 0;  ///< of them
  float score = 0;           ///< highest of any client's ladder
  int step = 0;              ///< highest TrustStep of any client
  float drift = 0;           ///< greatest Drift of a body, as a share of the one that counts
  std::int64_t audited = 0;  ///< mechanisms that were compared by the Auditor
  std::int64_t steps = 0;    ///< of bodies, by the Auditor
  double audit = 0;          ///< greatest share of a lie that it found, see SteadyGain
  std::int64_t breaks_refused = 0;    ///< proposed breaks without a load
  std::int64_t impacts_accepted = 0;  ///< reported and counted
  std::int64_t impacts_refused = 0;   ///< reported, and not explained
};

/// Runs the session with consequences of doubts (TrustMode::kAct). `shown`: the server publishes
/// its views, and so simulates all bodies of a small room; else only those that players share.
HonestOutcome RunHonest(ClusterConfig config, bool shown);

/// Returns the hashes of the server's world at the end of the session with trust off, watch and
/// act. `look` is given each server at its end.
std::vector<std::uint64_t> HashesByTrust(
    ClusterConfig config, const std::function<void(const Server&, TrustMode)>& look = {});

}  // namespace seam
