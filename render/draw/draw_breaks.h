#pragma once
/// Where a bond broke a moment ago: a crack across the line between the two parts.

#include "render/playback/playback.h"
#include "render/canvas/viewport.h"

namespace seam {

/// Breaks that the moment's view has applied, until half a second after they were ordered.
void DrawBreaks(DrawList& list, const Viewport& viewport, const Playback& playback,
                const Moment& moment, double tick);

}  // namespace seam
