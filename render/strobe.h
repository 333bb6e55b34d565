#pragma once
/// One collision in one picture: many exposures over each other, older ones fainter, the oracle's
/// ghosts with them; a row for each recording, a column for each view.

#include <vector>

#include "render/canvas/viewport.h"
#include "render/playback/playback.h"

namespace seam {

/// What the picture shows.
struct StrobePlan {
  double from_s = 0, to_s = 1;
  double step_s = 0.1;        ///< between exposures; the last one is at to_s or before
  Vec2 min{0, 0}, max{1, 1};  ///< of the world, m
  std::vector<int> peers;     ///< columns: whose views
  int width_px = 1280, height_px = 720;
};

/// Flags that replace what the plan would choose; NaN, 0: it chooses.
struct StrobeOptions {
  double from_s, to_s;
  int every_ticks = 0;
  int peer = -1;  ///< one column; -1: the clients
  int width_px = 0, height_px = 0;
};

/// When the first watched collision happens (by the oracle's jump of velocity), else the first
/// strong impact, else when the views are most wrong, else the middle; s.
double CollisionTime(const std::vector<Playback>& playbacks);

/// Chooses window, exposures, columns, the box of the world that holds what moves, and a height.
/// Requires at least one playback. Throws OperatorError when the window is empty.
StrobePlan PlanStrobe(const std::vector<Playback>& playbacks, const StrobeOptions& options);

void DrawStrobe(DrawList& list, const std::vector<Playback>& playbacks, const StrobePlan& plan);

}  // namespace seam
