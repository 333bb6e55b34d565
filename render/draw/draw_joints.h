#pragma once
/// Rods and pins between the bodies of a view.

#include "render/playback/playback.h"
#include "render/canvas/viewport.h"

namespace seam {

/// Distance joints as lines, to lie under the bodies. Where a body is not shown, nothing.
void DrawRods(DrawList& list, const Viewport& viewport, const Playback& playback,
              const Moment& moment, float opacity);

/// Hinges and axles as dots, to lie over the bodies, where bodies are large enough.
void DrawPins(DrawList& list, const Viewport& viewport, const Playback& playback,
              const Moment& moment, float opacity);

}  // namespace seam
