#pragma once
/// Numbers from recordings alone: error, stutter, backsteps, rebound, rest, cost. docs/metrics.md
/// defines each; this header names them.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/physics/scene.h"
#include "common/record/recording.h"

namespace seam {

/// The truth: poses of every moving body after every tick, by assembly id.
struct Oracle {
  std::int64_t first_tick = 0;
  std::vector<PartId> ids;                          ///< ascending
  std::vector<std::vector<BodyState>> ticks;        ///< [tick - first_tick][index in ids]
  const BodyState* At(std::int64_t tick, PartId id) const;
};

/// Simulates the recording's scene alone, with the inputs it recorded.
Oracle ComputeOracle(const Recording& recording);

/// The displayed path of peer 0 in a recording made with --mode oracle.
Oracle OracleFromRecording(const Recording& recording);

struct Measures {
  // Pose errors over all peers' views, bodies and ticks that the oracle has.
  double error_rms_m = 0, error_p95_m = 0, error_max_m = 0;
  double error_rms_rad = 0;
  double stutter_mps2 = 0;            ///< RMS of the second difference minus the oracle's
  std::int64_t backsteps = 0;         ///< displayed moves against the body's velocity
  std::optional<double> rebound;      ///< only for scenes that watch a collision
  std::optional<double> rest_ticks;   ///< only if the scene comes to rest in the recording
  double handover_jump_m = 0;         ///< largest jump of a view at a change of authority
  std::int64_t handovers = 0;
  double bytes_per_s = 0;             ///< mean over clients, both directions, UDP payload
  double cpu_us_per_s = 0;            ///< mean over peers, per simulated second
  // By tick, RMS over peers' views and bodies: what the strip of the renderer draws.
  std::vector<double> error_by_tick_m;
  std::int64_t first_tick = 0;
  std::map<int, double> error_rms_by_peer_m;
};

Measures Measure(const Recording& recording, const Oracle& oracle);

}  // namespace seam
