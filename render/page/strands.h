#pragma once
/// Strands of a view (hair, flags) as columns of a review page.
///
/// A section, all numbers varints: number of strands; of each: its index in the scene, the part it
/// hangs on, its width in mm, its points, how many ticks it is known in; these ticks, then x and y
/// of each point in mm, as columns of first differences over the ticks.

#include "render/page/column.h"
#include "render/playback/playback.h"

namespace seam {

/// Empty where the peer showed none.
PageBytes EncodeStrands(const Playback& playback, int peer);

}  // namespace seam
