#pragma once
/// What the server decides, on a panel: triggers as dashed boxes, health over the parts that have
/// some, the players' scores in a line.

#include "render/canvas/viewport.h"
#include "render/playback/playback.h"

namespace seam {

/// Before the bodies. Taken pickups are not drawn.
void DrawTriggers(DrawList& list, const Viewport& viewport, const Playback& playback,
                  const Moment& moment, double tick);
/// After the bodies: a bar for each part that has less than all its health, or more than none.
void DrawHealth(DrawList& list, const Viewport& viewport, const Playback& playback,
                const Moment& moment, double tick);
/// Below the panel's caption; nothing while nobody has a score, a checkpoint or a lap.
void DrawScores(DrawList& list, const Rect& panel, const Playback& playback, double tick);

}  // namespace seam
