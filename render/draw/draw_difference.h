#pragma once
/// Two runs in one world: the first pale, the second over it, its bodies coloured by how far they
/// are from where the first has them.

#include "render/canvas/viewport.h"
#include "render/playback/playback.h"

namespace seam {

/// Draws the second's bodies and a line from each to its place in the first. Bodies that only one
/// has are outlined. `look` is of the first: peer, tick.
void DrawDifference(DrawList& list, const Viewport& viewport, const Playback& first,
                    const Playback& second, int peer, double now_s);

/// Root mean square over the bodies that both show of how far their centres are apart, m; negative
/// where there are none.
double ApartOf(const Playback& first, const Playback& second, int peer, double now_s);

}  // namespace seam
