#pragma once
/// The measures of displayed motion as a person sees it, one per file; defined in docs/metrics.md.

#include "common/measure/measure.h"
#include "common/measure/screen/extent.h"
#include "common/measure/screen/own.h"

namespace seam {

/// Caches that these measures share.
struct Screen {
  /// `revisions` nullptr: the scene is not known. Both arguments must outlive this.
  Screen(const Recording& recording, const RevisionHistory* revisions)
      : extents(revisions), own(recording, revisions) {}
  Extents extents;
  OwnBodies own;
};

/// point_error.cpp: sets error_others_m, error_own_m and error_server_m.
void MeasurePointError(const Recording& recording, const Oracle& oracle, Screen& screen,
                       Measures* measures);

/// served.cpp: sets error_served_m and inputs_late, in modes where they apply.
void MeasureServed(const Recording& recording, Screen& screen, Measures* measures);

/// screen.cpp: sets path_error_rms_m, view_age_ms, seen and overlap_p99_m, from the views of all
/// clients.
void MeasureScreens(const Recording& recording, const Oracle& oracle,
                    const RevisionHistory* revisions, Screen& screen, Measures* measures);

/// kinetic.cpp: sets energy_ratio_min, energy_ratio_max and hottest_ratio, from all peers' views.
void MeasureKinetic(const Recording& recording, const Oracle& oracle,
                    const RevisionHistory& revisions, Measures* measures);

}  // namespace seam
