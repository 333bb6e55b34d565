#pragma once
/// Two runs in one world: the first pale, the second over it, its bodies coloured by their distance
/// from the first run's.

#include "render/canvas/viewport.h"
#include "render/playback/playback.h"

namespace seam {

/// Draws the second run's bodies, and a line to each from its place in the first. Bodies that the
/// first lacks are outlined.
void DrawDifference(DrawList& list, const Viewport& viewport, const Playback& first,
                    const Playback& second, int peer, double now_s);

/// Returns the root mean square distance of the bodies' positions in the two runs, over bodies that
/// both show, m; negative where there are none.
double ApartOf(const Playback& first, const Playback& second, int peer, double now_s);

}  // namespace seam
