#pragma once
/// Game rules on a panel: triggers as dashed boxes, health bars over parts, the players' scores in
/// a line.

#include <string>

#include "render/canvas/viewport.h"
#include "render/draw/text_places.h"
#include "render/playback/playback.h"

namespace seam {

/// Draws triggers but pickups that were taken, with their names where there is room. Call before
/// drawing the bodies.
void DrawTriggers(DrawList& list, TextPlaces& places, const Viewport& viewport,
                  const Playback& playback, const Moment& moment, double tick);
/// Draws a health bar at each part with health. Call after drawing the bodies.
void DrawHealth(DrawList& list, const Viewport& viewport, const Playback& playback,
                const Moment& moment, double tick);
/// The line of all scores, and its area below the panel's caption; empty without any score,
/// checkpoint or lap.
struct ScoreLine {
  std::string text;
  Rect area;
};
ScoreLine ScoresAt(const DrawList& list, const Rect& panel, const Playback& playback, double tick);
void DrawScores(DrawList& list, const ScoreLine& scores);

}  // namespace seam
