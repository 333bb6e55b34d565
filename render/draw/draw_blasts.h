#pragma once
/// Explosions on a panel: charges that have not gone off, and a flash and a ring for recent blasts.

#include "render/canvas/viewport.h"
#include "render/playback/playback.h"

namespace seam {

/// Draws each charge as a dot with its radius, dashed, until a matching blast has been ordered.
/// Call before drawing the bodies.
void DrawCharges(DrawList& list, const Viewport& viewport, const Playback& playback,
                 const Moment& moment, double tick);

/// Draws the blasts that the moment's view has applied: a flash of 0.1 s, and for half a second a
/// ring that grows to the blast's radius. Call after drawing the bodies.
void DrawBlasts(DrawList& list, const Viewport& viewport, const Playback& playback,
                const Moment& moment, double tick);

}  // namespace seam
