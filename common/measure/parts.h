#pragma once
/// The single measures that Measure combines, one per file; docs/metrics.md defines each.

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "common/measure/measure.h"
#include "common/measure/revisions.h"
#include "common/scene/assembly.h"

namespace seam {

/// Returns the seconds per tick of a recording.
double TickSeconds(const Recording& recording);

/// error.cpp: sets error_*, shown_error_*, error_rms_by_peer_m and compared.
void MeasureError(const Recording& recording, const Oracle& oracle, Measures* measures);

// `revisions` below: nullptr where bodies never change.

/// smoothness.cpp: sets stutter_mps2, stutter_shown_mps2 and backsteps.
void MeasureSmoothness(const Recording& recording, const Oracle& oracle,
                       const RevisionHistory* revisions, Measures* measures);

/// A peer's views of three successive ticks; nullptr for a missing view.
struct ViewTrio {
  const View* now = nullptr;  ///< not null
  const View* before = nullptr;
  const View* earlier = nullptr;
};

/// The oracle's tick that a view is compared with: the view's, or the one that it shows of a body.
enum class Truth { kOfTick, kOfMomentShown };

/// smoothness.cpp: returns one squared sample of stutter_shown_mps2 (kOfTick: of stutter_mps2),
/// (m/s^2)^2, for body i of trio.now; nullopt where a view or the oracle lacks one of the ticks, or
/// the body's parts changed. `h`: s per tick.
std::optional<double> StutterSquared(const ViewTrio& trio, std::size_t i, const Oracle& oracle,
                                     const RevisionHistory* revisions, double h,
                                     Truth truth = Truth::kOfMomentShown);

/// seam.cpp: sets seam_rms_m and seam_stutter_mps2.
void MeasureSeam(const Recording& recording, const RevisionHistory* revisions, Measures* measures);

/// rebound.cpp: returns the share of the oracle's momentum transfer that a collision really
/// transferred. `masses`: of the struck assemblies by id, kg. nullopt: no collision, or views of it
/// are missing.
std::optional<double> Rebound(const Recording& recording, const Oracle& oracle,
                              const std::map<PartId, double>& masses, std::int64_t around_tick);

/// rest.cpp: returns the ticks from the oracle's rest until all peers show bit-equal poses.
std::optional<double> RestTicks(const Recording& recording, const Oracle& oracle);

/// rest.cpp: returns the RMS displayed speed, m/s, from half a second after the oracle's rest.
std::optional<double> RestJitter(const Recording& recording, const Oracle& oracle);

/// displayed.cpp: sets penetration_m, joint_drift_m, energy_gain_j, oracle_penetration_m and
/// oracle_joint_drift_m.
void MeasureDisplayed(const Recording& recording, const Oracle& oracle,
                      const RevisionHistory& revisions, Measures* measures);

/// handover.cpp: true if the view's peer claims authority over the body.
bool Claims(const View& view, PartId id);

/// changes.cpp: sets topology_lag_s, lost and left_bounds.
void MeasureChanges(const Recording& recording, const RevisionHistory& revisions,
                    Measures* measures);

/// handover.cpp: sets handover_* and handovers. `mechanisms`: by assembly id, for worlds whose
/// bodies never change; an absent body is a mechanism by itself.
void MeasureHandover(const Recording& recording, const std::map<PartId, int>& mechanisms,
                     Measures* measures, const RevisionHistory* revisions = nullptr);

/// cost.cpp: sets bytes_per_s, sent_bytes_per_s and cpu_us_per_s.
void MeasureCost(const Recording& recording, Measures* measures);

}  // namespace seam
