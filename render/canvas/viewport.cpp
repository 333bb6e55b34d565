#include "render/canvas/viewport.h"

#include <algorithm>

#include "common/base/check.h"

namespace seam {

bool Viewport::Sees(const Vec2& world, float radius) const {
  // Two pixels more for outlines.
  const float half_width = panel.width / 2 / px_per_m + radius + 2 / px_per_m;
  const float half_height = panel.height / 2 / px_per_m + radius + 2 / px_per_m;
  return std::abs(world.x() - centre.x()) <= half_width &&
         std::abs(world.y() - centre.y()) <= half_height;
}

Viewport Fit(const Rect& panel, const Vec2& min, const Vec2& max) {
  const Vec2 size = (max - min).cwiseMax(1e-3f);
  Viewport viewport;
  viewport.panel = panel;
  viewport.centre = (min + max) / 2;
  viewport.px_per_m = std::min(panel.width / size.x(), panel.height / size.y());
  return viewport;
}

std::vector<Rect> Tile(const Rect& area, int count, float aspect, float gap, float below) {
  SEAM_ASSERT(count > 0);
  int best_columns = 1;
  float best = 0;
  for (int columns = 1; columns <= count; ++columns) {
    const int rows = (count + columns - 1) / columns;
    const float width =
        (area.width - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns);
    const float height =
        (area.height - gap * static_cast<float>(rows - 1)) / static_cast<float>(rows);
    const float scale = std::min(width / aspect, height - below);
    if (scale <= best) continue;
    best = scale;
    best_columns = columns;
  }
  const int rows = (count + best_columns - 1) / best_columns;
  const float height =
      (area.height - gap * static_cast<float>(rows - 1)) / static_cast<float>(rows);
  std::vector<Rect> panels;
  for (int i = 0; i < count; ++i) {
    const int row = i / best_columns, column = i % best_columns;
    // An incomplete last row is stretched to the full width, to leave no hole in the page.
    const auto in_row = static_cast<float>(std::min(best_columns, count - row * best_columns));
    const float width = (area.width - gap * (in_row - 1)) / in_row;
    panels.push_back({area.x + static_cast<float>(column) * (width + gap),
                      area.y + static_cast<float>(row) * (height + gap), width, height});
  }
  return panels;
}

}  // namespace seam
