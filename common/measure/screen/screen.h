#pragma once
/// The measures of what a person sees on a screen, one per file; docs/metrics.md defines each.

#include "common/measure/measure.h"
#include "common/measure/screen/extent.h"
#include "common/measure/screen/own.h"

namespace seam {

/// What they all look up.
struct Screen {
  /// `revisions` nullptr: the scene is not known. Both must outlive this.
  Screen(const Recording& recording, const RevisionHistory* revisions)
      : extents(revisions), own(recording, revisions) {}
  Extents extents;
  OwnBodies own;
};

/// point_error.cpp: error_others_m, error_own_m, error_server_m.
void MeasurePointError(const Recording& recording, const Oracle& oracle, Screen& screen,
                       Measures* measures);

/// screen.cpp: path_error_rms_m, view_age_ms and seen, of the screens of all clients.
void MeasureScreens(const Recording& recording, const Oracle& oracle,
                    const RevisionHistory* revisions, Screen& screen, Measures* measures);

/// kinetic.cpp: energy_ratio_min, energy_ratio_max, hottest_ratio, of all peers.
void MeasureKinetic(const Recording& recording, const Oracle& oracle,
                    const RevisionHistory& revisions, Measures* measures);

}  // namespace seam
