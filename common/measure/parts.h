#pragma once
/// The single measures that Measure puts together, one per file; docs/metrics.md defines each.

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "common/measure/measure.h"
#include "common/measure/revisions.h"
#include "common/scene/assembly.h"

namespace seam {

/// Seconds per tick of a recording.
double TickSeconds(const Recording& recording);

/// error.cpp: error_*, error_by_tick_m, error_rms_by_peer_m, compared.
void MeasureError(const Recording& recording, const Oracle& oracle, Measures* measures);

// `revisions` below: nullptr where bodies never change.

/// smoothness.cpp: stutter_mps2 and backsteps.
void MeasureSmoothness(const Recording& recording, const Oracle& oracle,
                       const RevisionHistory* revisions, Measures* measures);

/// A peer's views of three successive ticks; nullptr where there is none.
struct ViewTrio {
  const View* now = nullptr;  ///< not null
  const View* before = nullptr;
  const View* earlier = nullptr;
};

/// smoothness.cpp: the square of what stutter_mps2 is the root mean square of, (m/s^2)^2, for body
/// i of trio.now; nullopt where a tick, the oracle, or the body as it is now is missing. `h`: s per
/// tick.
std::optional<double> StutterSquared(const ViewTrio& trio, std::size_t i, const Oracle& oracle,
                                     const RevisionHistory* revisions, double h);

/// seam.cpp: seam_rms_m and seam_stutter_mps2.
void MeasureSeam(const Recording& recording, const RevisionHistory* revisions, Measures* measures);

/// rebound.cpp: the share of the oracle's momentum transfer that a collision really transferred.
/// `masses`: of the struck assemblies by id, kg. nullopt: no collision, or it was not recorded.
std::optional<double> Rebound(const Recording& recording, const Oracle& oracle,
                              const std::map<PartId, double>& masses, std::int64_t around_tick);

/// rest.cpp: ticks from the oracle's rest until all peers show the same bits.
std::optional<double> RestTicks(const Recording& recording, const Oracle& oracle);

/// rest.cpp: RMS displayed speed, m/s, from half a second after the oracle came to rest.
std::optional<double> RestJitter(const Recording& recording, const Oracle& oracle);

/// displayed.cpp: penetration_m, joint_drift_m, energy_gain_j, and the oracle's own of the first
/// two.
void MeasureDisplayed(const Recording& recording, const Oracle& oracle,
                      const RevisionHistory& revisions, Measures* measures);

/// changes.cpp: topology_lag_s, lost, left_bounds.
void MeasureChanges(const Recording& recording, const RevisionHistory& revisions,
                    Measures* measures);

/// handover.cpp: handover_* and handovers. `mechanisms`: by assembly id, where bodies never change;
/// a body that is not in it is a mechanism by itself.
void MeasureHandover(const Recording& recording, const std::map<PartId, int>& mechanisms,
                     Measures* measures, const RevisionHistory* revisions = nullptr);

/// cost.cpp: bytes_per_s, sent_bytes_per_s and cpu_us_per_s.
void MeasureCost(const Recording& recording, Measures* measures);

}  // namespace seam
