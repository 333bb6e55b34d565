#pragma once
/// Bodies of water on a panel: a tint behind everything that moves, a thinner one over it, so that
/// what is under water looks it, and the level as a line.

#include "render/playback/playback.h"
#include "render/canvas/viewport.h"

namespace seam {

/// Before the bodies: the water, and its flow as arrows.
void DrawWaters(DrawList& list, const Viewport& viewport, const Playback& playback);
/// After the bodies: the veil over what is under water, and the level.
void DrawSurfaces(DrawList& list, const Viewport& viewport, const Playback& playback);

}  // namespace seam
