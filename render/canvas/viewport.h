#pragma once
/// Mapping between the world and a panel.

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
  /// True if an object of this radius (m) about this point may be visible.
  bool Sees(const Vec2& world, float radius) const;
};

/// Returns a viewport of all of the box min..max (m), as large as the panel allows.
Viewport Fit(const Rect& panel, const Vec2& min, const Vec2& max);

/// Returns the grid of `count` panels in `area` that shows boxes of this aspect (width over height)
/// largest, from left to right, then down. `gap`: px between panels; `below`: px at the bottom of
/// each panel reserved for other content.
std::vector<Rect> Tile(const Rect& area, int count, float aspect, float gap, float below = 0);

}  // namespace seam
