#pragma once
/// Numbers from recordings alone: error, stutter, backsteps, seam, rebound, rest, penetration,
/// joint drift, energy, hand-over, cost. docs/metrics.md defines each; this header names them.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/measure/oracle.h"
#include "common/record/recording.h"
#include "common/scene/scene.h"

namespace seam {

struct Measures {
  // DoublePose errors over all peers' views, bodies and ticks that the oracle has.
  double error_rms_m = 0, error_p95_m = 0, error_max_m = 0;
  double error_rms_rad = 0;
  // RMS of the largest displacement of a point of each body: of what clients see of others, of
  // what they see of their own, and of the server's view. Empty where there is no such view.
  std::optional<double> error_others_m, error_own_m, error_server_m;
  // Of what clients see of others, against the oracle at the tick that is shown.
  std::optional<double> path_error_rms_m;
  std::optional<double> view_age_ms;  ///< how old that is; empty if nothing tells it
  // From an input to motion by it, median: on the player's own screen, in the server's view, and on
  // the other players' screens. Empty when nothing responds, or is not known by the clock.
  std::optional<double> response_own_ms, response_server_ms, response_other_ms;
  std::optional<double> seen;  ///< share of the body-seconds in which a person would notice
  // Kinetic energy in windows of a second, of any peer, as displayed and of its physics, as a
  // multiple of the oracle's; and of the hottest body as one of the oracle's hottest.
  std::optional<double> energy_ratio_min, energy_ratio_max, hottest_ratio;
  double stutter_mps2 = 0;     ///< RMS of the second difference minus the oracle's
  std::int64_t backsteps = 0;  ///< displayed moves against the body's velocity
  // Between peers: displayed against the authority's display. Empty when nobody follows anybody.
  std::optional<double> seam_rms_m;
  std::optional<double> seam_stutter_mps2;
  std::optional<double> rebound;          ///< only for scenes that watch a collision
  std::optional<double> rest_ticks;       ///< only if the scene comes to rest in the recording
  std::optional<double> jitter_rest_mps;  ///< RMS displayed speed once the oracle rests
  // Of what is shown, by the scene's geometry; empty when no view shows all moving bodies.
  std::optional<double> penetration_m;  ///< deepest overlap of two parts, 10 times a second
  std::optional<double> joint_drift_m;  ///< worst joint, any tick; empty without joints
  std::optional<double> energy_gain_j;  ///< most above the oracle's energy around that tick
  std::optional<double> oracle_penetration_m, oracle_joint_drift_m;  ///< the oracle's own
  double handover_jump_m = 0;  ///< largest jump of a view at a change of authority
  std::int64_t handovers = 0;  ///< changes of authority over a mechanism
  // How far the new authority is from the old one when it takes up. Empty without a hand-over.
  std::optional<double> handover_gap_m, handover_dv_mps;
  std::optional<double> handover_gap_p95_m, handover_dv_p95_mps;  ///< the same, nearest rank
  // Of worlds whose bodies change; empty without edits.
  std::optional<double> topology_lag_s;  ///< longest that a peer lacked an edit that was ordered
  std::optional<std::int64_t> lost;      ///< bodies too few or too many in views, over all ticks
  std::int64_t left_bounds = 0;  ///< parts that were removed because they left the scene's bounds
  double bytes_per_s = 0;                ///< mean over clients, both directions, UDP payload
  double sent_bytes_per_s = 0;           ///< the same, what they send alone
  double cpu_us_per_s = 0;               ///< mean over peers, per simulated second
  /// Poses that were compared: peers x ticks x bodies. 0: nothing was, and the errors mean nothing.
  std::int64_t compared = 0;
  // By tick, RMS over peers' views and bodies: what the strip of the renderer draws. 0 where
  // nothing was compared; [tick - first_tick], for all ticks of the recording.
  std::vector<double> error_by_tick_m;
  std::int64_t first_tick = 0;
  std::map<int, double> error_rms_by_peer_m;
};

/// Everything at once. Throws OperatorError when the recorded scene does not parse; a recording
/// without a scene (made by hand) has no rebound, penetration, drift or energy, and each of its
/// bodies is a mechanism.
Measures Measure(const Recording& recording, const Oracle& oracle);

}  // namespace seam
