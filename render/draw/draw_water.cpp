#include "render/draw/draw_water.h"

#include <algorithm>
#include <cmath>

#include "render/canvas/palette.h"

namespace seam {
namespace {

constexpr float kTint = 0.22f, kVeil = 0.16f;
/// Between arrows of the flow, px at scale 1.
constexpr float kArrowsApart = 130;

/// What of a water the panel shows; without area if nothing.
Rect OnPanel(const Viewport& viewport, const Water& water) {
  const Vec2 a = viewport.ToPx({water.min.x(), water.max.y()});
  const Vec2 b = viewport.ToPx({water.max.x(), water.min.y()});
  const Rect& panel = viewport.panel;
  const float x0 = std::max(a.x(), panel.x), x1 = std::min(b.x(), panel.right());
  const float y0 = std::max(a.y(), panel.y), y1 = std::min(b.y(), panel.bottom());
  return {x0, y0, std::max(0.0f, x1 - x0), std::max(0.0f, y1 - y0)};
}

bool Seen(const Rect& rect) { return rect.width > 0 && rect.height > 0; }

/// Pale arrows along the flow, fixed to the world, longer where it is faster.
void DrawFlow(DrawList& list, const Viewport& viewport, const Water& water, const Rect& area) {
  const float speed = water.flow.norm(), scale = list.font().scale();
  if (speed <= 0) return;
  const Vec2 way(water.flow.x() / speed, -water.flow.y() / speed);
  const Vec2 side(-way.y(), way.x());
  const float length = std::min(20 + 20 * speed, 60.0f) * scale, head = 4 * scale;
  const float step = kArrowsApart * scale;
  const Line line{1.2f * scale, Faded(kWaterLine, 0.5f), 0};
  const Vec2 origin = viewport.ToPx(water.min);
  for (float y = area.y + step / 4; y < area.bottom() - head; y += step / 2) {
    const float first = origin.x() + std::ceil((area.x - origin.x()) / step) * step;
    for (float x = first; x + length < area.right(); x += step) {
      const Vec2 tip = Vec2(x, y) + length * way;
      list.Stroke({{x, y}, tip}, false, line);
      list.Stroke({tip - head * (way + 0.6f * side), tip, tip - head * (way - 0.6f * side)}, false,
                  line);
    }
  }
}

}  // namespace

void DrawWaters(DrawList& list, const Viewport& viewport, const Playback& playback) {
  for (const Water& water : playback.scene().waters) {
    const Rect area = OnPanel(viewport, water);
    if (!Seen(area)) continue;
    list.FillRect(area, Faded(kWater, kTint));
    DrawFlow(list, viewport, water, area);
  }
}

void DrawSurfaces(DrawList& list, const Viewport& viewport, const Playback& playback) {
  for (const Water& water : playback.scene().waters) {
    const Rect area = OnPanel(viewport, water);
    if (!Seen(area)) continue;
    list.FillRect(area, Faded(kWater, kVeil));
    const float level = viewport.ToPx(water.max).y();
    if (level < viewport.panel.y) continue;
    list.Stroke({{area.x, level}, {area.right(), level}}, false,
                {1.5f * list.font().scale(), Faded(kWaterLine, 0.8f), 0});
  }
}

}  // namespace seam
