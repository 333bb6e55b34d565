#pragma once
/// Explosions on a panel: charges that have not gone off, and a flash and a ring where a blast was
/// a moment ago.

#include "render/canvas/viewport.h"
#include "render/playback/playback.h"

namespace seam {

/// Before the bodies: a dot with its radius, dashed, until a blast like it has been ordered.
void DrawCharges(DrawList& list, const Viewport& viewport, const Playback& playback,
                 const Moment& moment, double tick);

/// After the bodies: a flash of 0.1 s, and for half a second a ring that grows to the blast's
/// radius. Of the blasts that the moment's view has applied.
void DrawBlasts(DrawList& list, const Viewport& viewport, const Playback& playback,
                const Moment& moment, double tick);

}  // namespace seam
