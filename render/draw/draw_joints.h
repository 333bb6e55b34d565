#pragma once
/// Rods and pins between the bodies of a view, and cracks where a bond broke a moment ago.

#include "render/canvas/viewport.h"
#include "render/playback/playback.h"

namespace seam {

/// Distance joints as lines, to lie under the bodies. Where a body is not shown, nothing.
void DrawRods(DrawList& list, const Viewport& viewport, const Playback& playback,
              const Moment& moment, float opacity);

/// Hinges and axles as dots, to lie over the bodies, where bodies are large enough.
void DrawPins(DrawList& list, const Viewport& viewport, const Playback& playback,
              const Moment& moment, float opacity);

/// Breaks that the moment's view has applied, until half a second after they were ordered.
void DrawBreaks(DrawList& list, const Viewport& viewport, const Playback& playback,
                const Moment& moment, double tick);

}  // namespace seam
