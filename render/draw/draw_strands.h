#pragma once
/// Strands (hair, scarves) of one peer's view: cosmetic, simulated by that peer alone.

#include "render/canvas/viewport.h"
#include "render/playback/playback.h"

namespace seam {

void DrawStrands(DrawList& list, const Viewport& viewport, const Playback& playback,
                 const Moment& moment, int peer);

}  // namespace seam
