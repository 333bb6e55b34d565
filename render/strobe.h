#pragma once
/// One collision in one picture: superimposed exposures, older ones fainter, with the oracle's
/// ghosts; a row for each recording, a column for each view.

#include <vector>

#include "render/canvas/viewport.h"
#include "render/playback/playback.h"

namespace seam {

/// Content and size of the picture.
struct StrobePlan {
  double from_s = 0, to_s = 1;
  double step_s = 0.1;        ///< between exposures; the last one is at to_s or before
  Vec2 min{0, 0}, max{1, 1};  ///< displayed box of the world, m
  std::vector<int> peers;     ///< the displayed view of each column
  int width_px = 1280, height_px = 720;
};

/// Flags that replace the plan's choices; NaN, 0: the plan chooses.
struct StrobeOptions {
  double from_s, to_s;
  int every_ticks = 0;
  int peer = -1;  ///< one column; -1: the clients
  int width_px = 0, height_px = 0;
};

/// Returns the time of the first watched collision (by the oracle's jump of velocity), else of the
/// first strong impact, else of the greatest error, else the middle; s.
double CollisionTime(const std::vector<Playback>& playbacks);

/// Chooses window, exposures, columns, the box of the world around moving bodies, and a height.
/// Requires at least one playback. Throws OperatorError when the window is empty.
StrobePlan PlanStrobe(const std::vector<Playback>& playbacks, const StrobeOptions& options);

void DrawStrobe(DrawList& list, const std::vector<Playback>& playbacks, const StrobePlan& plan);

}  // namespace seam
