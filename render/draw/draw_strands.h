#pragma once
/// Hair and scarves: what hangs on bodies in one peer's view, and nowhere else.

#include "render/canvas/viewport.h"
#include "render/playback/playback.h"

namespace seam {

void DrawStrands(DrawList& list, const Viewport& viewport, const Playback& playback,
                 const Moment& moment, int peer);

}  // namespace seam
