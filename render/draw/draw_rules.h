#pragma once
/// Game rules on a panel: triggers as dashed boxes, health bars over parts, the players' scores in
/// a line.

#include "render/canvas/viewport.h"
#include "render/playback/playback.h"

namespace seam {

/// Draws triggers but pickups that were taken. Call before drawing the bodies.
void DrawTriggers(DrawList& list, const Viewport& viewport, const Playback& playback,
                  const Moment& moment, double tick);
/// Draws a health bar at each part with health. Call after drawing the bodies.
void DrawHealth(DrawList& list, const Viewport& viewport, const Playback& playback,
                const Moment& moment, double tick);
/// Draws the scores below the panel's caption; nothing without any score, checkpoint or lap.
void DrawScores(DrawList& list, const Rect& panel, const Playback& playback, double tick);

}  // namespace seam
