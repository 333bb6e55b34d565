#pragma once
/// Where a peer's copies differed from what their authorities told of the same tick
/// (divergence_t), and which told states the server doubted (audit_t).

#include "render/canvas/viewport.h"
#include "render/draw/draw_world.h"
#include "render/draw/text_places.h"
#include "render/playback/playback.h"

namespace seam {

/// Draws a ring about each such body of the last second, with the distance; a pale one if inputs
/// of that tick were missing, so that the peer could not know better.
void DrawDivergences(DrawList& list, TextPlaces& places, const Viewport& viewport,
                     const Playback& playback, const DrawnRevision& revision,
                     const WorldLook& look);

/// Draws a ring about each body of which the server doubted or refused a state in the last second.
void DrawDoubts(DrawList& list, TextPlaces& places, const Viewport& viewport,
                const Playback& playback, const DrawnRevision& revision, const WorldLook& look);

}  // namespace seam
