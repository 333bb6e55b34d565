#pragma once
/// Lists where peers differed from each other, from a recording (divergence_t, docs/trust.md).

#include <string>

#include "common/record/recording.h"
#include "common/scene/scene.h"

namespace seam {

/// Returns a line for each body and message, in the order of ticks, after a line with the column
/// names, and the number of those that found no room; "none" if there are none. `scene`: the
/// recording's, for names.
std::string FormatDivergences(const Recording& recording, const Scene& scene);

}  // namespace seam
