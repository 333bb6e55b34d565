#pragma once
/// Where the world lies on a panel.

#include "render/canvas/draw_list.h"

namespace seam {

/// World metres (y upwards) to pixels (y downwards), the same scale both ways.
struct Viewport {
  Rect panel;         ///< px
  Vec2 centre{0, 0};  ///< m, in the middle of the panel
  float px_per_m = 20;

  Vec2 ToPx(const Vec2& world) const {
    return {panel.x + panel.width / 2 + (world.x() - centre.x()) * px_per_m,
            panel.y + panel.height / 2 - (world.y() - centre.y()) * px_per_m};
  }
  Vec2 ToWorld(const Vec2& px) const {
    return {centre.x() + (px.x() - panel.x - panel.width / 2) / px_per_m,
            centre.y() - (px.y() - panel.y - panel.height / 2) / px_per_m};
  }
  /// May a thing of this radius (m) about this point be seen?
  bool Sees(const Vec2& world, float radius) const;
};

/// Shows all of the box min..max (m), as large as the panel allows.
Viewport Fit(const Rect& panel, const Vec2& min, const Vec2& max);

/// The grid of `count` panels in `area` that shows boxes of this aspect (width over height)
/// largest; `gap` px between them, and the lowest `below` px of each for something else. From left
/// to right, then down.
std::vector<Rect> Tile(const Rect& area, int count, float aspect, float gap, float below = 0);

}  // namespace seam
