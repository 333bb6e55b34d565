#pragma once
/// Rods and pins between the bodies of a view, and cracks of recently broken bonds.

#include "render/canvas/viewport.h"
#include "render/playback/playback.h"

namespace seam {

/// Draws distance joints as lines. Skips joints of a body that is not shown. Call before drawing
/// the bodies.
void DrawRods(DrawList& list, const Viewport& viewport, const Playback& playback,
              const Moment& moment, float opacity);

/// Draws hinges and axles as dots, if the scale is large enough. Call after drawing the bodies.
void DrawPins(DrawList& list, const Viewport& viewport, const Playback& playback,
              const Moment& moment, float opacity);

/// Draws breaks that the moment's view has applied, until half a second after their order.
void DrawBreaks(DrawList& list, const Viewport& viewport, const Playback& playback,
                const Moment& moment, double tick);

}  // namespace seam
