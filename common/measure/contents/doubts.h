#pragma once
/// Lists the server's doubts about clients, from the audits of a recording (docs/trust.md).

#include <string>

#include "common/record/recording.h"
#include "common/scene/scene.h"

namespace seam {

/// Returns a line for each doubt and each step, in the order of ticks, after a line with the column
/// names; "none" if there are none. `scene`: the recording's, for names.
std::string FormatDoubts(const Recording& recording, const Scene& scene);

}  // namespace seam
