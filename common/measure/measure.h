#pragma once
/// The measures of a recording: error, stutter, backsteps, seam, rebound, rest, penetration, joint
/// drift, energy, hand-over, cost. docs/metrics.md defines each.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/measure/oracle.h"
#include "common/record/recording.h"
#include "common/scene/scene.h"

namespace seam {

/// All measures of one recording.
struct Measures {
  // Pose errors over the views of all peers, and all bodies and ticks that the oracle has.
  double error_rms_m = 0, error_p95_m = 0, error_max_m = 0;
  double error_rms_rad = 0;
  // RMS of the largest displacement of a point of each body: of other players' bodies in clients'
  // views, of clients' own bodies, and of the server's view. Empty where there is no such view.
  std::optional<double> error_others_m, error_own_m, error_server_m;
  // Mode central: other players' bodies in clients' views against the server's view of the tick.
  std::optional<double> error_served_m;
  // Inputs that reached the server after the tick in which they should have acted, and that it did
  // not guess. 0 where peers go back to a late input; empty where inputs have no tick of their own.
  std::optional<std::int64_t> inputs_late;
  // As error_others_m, against the oracle at the tick that is shown.
  std::optional<double> path_error_rms_m;
  std::optional<double> view_age_ms;  ///< age of that tick; empty if no span has a reliable age
  // Median latency from an input to visible motion: on the player's own screen, in the server's
  // view, and on the other players' screens. Empty without a response or without clock times.
  std::optional<double> response_own_ms, response_server_ms, response_other_ms;
  std::optional<double> seen;  ///< share of body-seconds in which a person would notice an error
  // Overlap of clients' own bodies with others' beyond the oracle's: 99 % of the ticks of pairs
  // that overlap, in the view or in the oracle, are below. Empty if no pair does.
  std::optional<double> overlap_p99_m;
  // Kinetic energy of any peer in windows of a second, as displayed and by its velocities, as a
  // multiple of the oracle's. The hottest body is compared with the oracle's hottest.
  std::optional<double> energy_ratio_min, energy_ratio_max, hottest_ratio;
  double stutter_mps2 = 0;     ///< RMS of the second difference minus the oracle's
  double stutter_shown_mps2 = 0;  ///< the same, minus the oracle's at the tick that is shown
  std::int64_t backsteps = 0;  ///< displayed moves against the body's velocity
  // Displayed poses against those in the authority's view. Empty without a view to compare with.
  std::optional<double> seam_rms_m;
  std::optional<double> seam_stutter_mps2;
  std::optional<double> rebound;          ///< only for scenes that watch a collision
  std::optional<double> rest_ticks;       ///< only if the scene comes to rest in the recording
  std::optional<double> jitter_rest_mps;  ///< RMS displayed speed once the oracle rests
  // Errors of displayed states by the scene's geometry; empty when no view shows all moving bodies.
  std::optional<double> penetration_m;  ///< deepest overlap of two parts, 10 times a second
  std::optional<double> joint_drift_m;  ///< worst joint, any tick; empty without joints
  std::optional<double> energy_gain_j;  ///< greatest excess over the oracle's energy near that tick
  std::optional<double> oracle_penetration_m, oracle_joint_drift_m;  ///< the oracle's own
  double handover_jump_m = 0;  ///< largest jump of a view at a change of authority
  std::int64_t handovers = 0;  ///< changes of authority over a mechanism
  // Difference of the new authority's state from the old one's at a hand-over. Empty without one.
  std::optional<double> handover_gap_m, handover_dv_mps;
  std::optional<double> handover_gap_p95_m, handover_dv_p95_mps;  ///< nearest rank
  // For worlds whose bodies change; empty without edits.
  std::optional<double> topology_lag_s;  ///< longest time that a peer lacked an ordered edit
  std::optional<std::int64_t> lost;      ///< bodies too few or too many in views, over all ticks
  std::int64_t left_bounds = 0;  ///< parts that were removed because they left the scene's bounds
  double bytes_per_s = 0;                ///< mean over clients, both directions, UDP payload
  double sent_bytes_per_s = 0;           ///< mean over clients, upstream only
  double cpu_us_per_s = 0;               ///< mean over peers, per simulated second
  /// Number of compared poses: peers x ticks x bodies. With 0 the errors mean nothing.
  std::int64_t compared = 0;
  // Pose errors over the views of all peers against the oracle at the tick that is shown, as
  // pictures draw it.
  double shown_error_rms_m = 0, shown_error_p95_m = 0, shown_error_max_m = 0;
  // Their RMS over peers' views and bodies, indexed by [tick - first_tick] for all ticks of the
  // recording; the renderer's strip draws it. 0 where nothing was compared.
  std::vector<double> shown_error_by_tick_m;
  std::int64_t first_tick = 0;
  std::map<int, double> error_rms_by_peer_m;
};

/// Computes all measures but the response (MeasureResponse). Throws OperatorError when the recorded
/// scene does not parse. A recording without a scene (made by hand) has no rebound, penetration,
/// drift or energy, and each of its bodies is a mechanism.
Measures Measure(const Recording& recording, const Oracle& oracle);

}  // namespace seam
