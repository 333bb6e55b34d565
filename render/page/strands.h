#pragma once
/// Strands of a view (hair, flags) as columns of a review page.
///
/// Format of a section, all numbers varints: number of strands; for each: its index in the scene,
/// its part, its width in mm, the number of points, the number of ticks; these ticks, then x and y
/// of each point in mm, as columns of first differences over the ticks.

#include "render/page/column.h"
#include "render/playback/playback.h"

namespace seam {

/// Returns the section of a peer; empty if its views have no strands.
PageBytes EncodeStrands(const Playback& playback, int peer);

}  // namespace seam
