#pragma once
/// Layout of the rows and columns of a strobe picture.

#include "render/strobe.h"

namespace seam {

/// px at the picture's scale.
struct StrobeLayout {
  float scale = 1;
  float margin = 0, header = 0, footer = 0, labels = 0, gap = 0;
  float panel_width = 0, panel_height = 0;
};

StrobeLayout LayOutStrobe(const StrobePlan& plan, int rows);
/// Returns the picture's height at which the world's box fills each panel, within the limits of a
/// row's height.
int StrobeHeight(const StrobePlan& plan, int rows);
/// Returns the scale of text and lines, which depends on the width alone.
float StrobeScale(int width_px);

}  // namespace seam
