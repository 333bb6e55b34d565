#pragma once
/// Numbers from recordings alone: error, stutter, backsteps, seam, rebound, rest, penetration,
/// joint drift, energy, hand-over, cost. docs/metrics.md defines each; this header names them.

#include <cstdint>
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
  /// [tick - first_tick][index in ids]; empty for a tick that is not known.
  std::vector<std::vector<BodyState>> ticks;
  /// nullptr when the tick or the body is not known.
  const BodyState* At(std::int64_t tick, PartId id) const;
};

/// How far the floor's nudge moves one body, m; at least to the next float (8e-6 m at 100 m).
constexpr float kNudge = 1e-6f;
/// The same at the resolution of the wire, whose positions are whole 1/512 m: half of that.
constexpr float kWireNudge = 1.0f / 1024;

/// Simulates the recording's scene alone from tick 0 to the recording's last tick, with the inputs
/// it recorded: each in the tick it names, axes held over ticks without one, buttons acting on the
/// tick they go down. Throws OperatorError when the scene does not parse or the session is too long
/// (kOracleStatesMax).
/// `nudged_body` >= 0: with that body (an index into ids) moved by `nudge` m along x at the start,
/// at least to the next float.
Oracle ComputeOracle(const Recording& recording, int nudged_body = -1,
                     float nudge = kNudge);

/// The oracle's own sensitivity: RMS distance in m between it and itself with one body nudged, the
/// median over at most `bodies` bodies, evenly chosen. No method can be expected to be better:
/// where the floor is a metre, errors of a metre say nothing.
double ErrorFloor(const Recording& recording, const Oracle& oracle, float nudge = kNudge,
                  int bodies = 7);

/// Most ticks times bodies that ComputeOracle keeps: 24 bytes each.
constexpr std::int64_t kOracleStatesMax = 50'000'000;

/// The displayed path of peer 0 in a recording made with --mode oracle. Throws OperatorError for a
/// recording of another mode, or without views of peer 0.
Oracle OracleFromRecording(const Recording& recording);

struct Measures {
  // Pose errors over all peers' views, bodies and ticks that the oracle has.
  double error_rms_m = 0, error_p95_m = 0, error_max_m = 0;
  double error_rms_rad = 0;
  double stutter_mps2 = 0;            ///< RMS of the second difference minus the oracle's
  std::int64_t backsteps = 0;         ///< displayed moves against the body's velocity
  // Between peers: displayed against the authority's display. Empty when nobody follows anybody.
  std::optional<double> seam_rms_m;
  std::optional<double> seam_stutter_mps2;
  std::optional<double> rebound;      ///< only for scenes that watch a collision
  std::optional<double> rest_ticks;   ///< only if the scene comes to rest in the recording
  std::optional<double> jitter_rest_mps;  ///< RMS displayed speed once the oracle rests
  // Of what is shown, by the scene's geometry; empty when no view shows all moving bodies.
  std::optional<double> penetration_m;    ///< deepest overlap of two parts, 10 times a second
  std::optional<double> joint_drift_m;    ///< worst joint, any tick; empty without joints
  std::optional<double> energy_gain_j;    ///< most above the oracle's energy around that tick
  std::optional<double> oracle_penetration_m, oracle_joint_drift_m;   ///< the oracle's own
  double handover_jump_m = 0;         ///< largest jump of a view at a change of authority
  std::int64_t handovers = 0;         ///< changes of authority over a mechanism
  // How far the new authority is from the old one when it takes up. Empty without a hand-over.
  std::optional<double> handover_gap_m, handover_dv_mps;
  double bytes_per_s = 0;             ///< mean over clients, both directions, UDP payload
  double sent_bytes_per_s = 0;        ///< the same, what they send alone
  double cpu_us_per_s = 0;            ///< mean over peers, per simulated second
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
