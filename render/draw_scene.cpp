#include "render/draw_scene.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "render/draw_body.h"
#include "render/palette.h"

namespace seam {
namespace {

/// The smallest of 1, 2, 5 times ten to the n that is at least `least`.
float RoundUp(float least) {
  const float decade = std::pow(10.0f, std::floor(std::log10(least)));
  for (float step : {1.0f, 2.0f, 5.0f})
    if (step * decade >= least * 0.999f) return step * decade;
  return 10 * decade;
}

struct Region {
  Rect inner, outer;    ///< px; the region, and with its buffer zone
  Colour colour;
  std::string name;
};

Rect Box(const Viewport& viewport, const Vec2& min, const Vec2& max) {
  const Vec2 a = viewport.ToPx({min.x(), max.y()}), b = viewport.ToPx({max.x(), min.y()});
  return {a.x(), a.y(), b.x() - a.x(), b.y() - a.y()};
}

std::vector<Region> RegionsOf(const Viewport& viewport, const Playback& playback) {
  std::vector<Region> regions;
  const Room& room = playback.recording().room;
  if (room.mode != "strict" && room.mode != "buffer") return regions;
  const float band = room.mode == "buffer" ? playback.scene().buffer_m : 0;
  for (int peer : playback.peers()) {
    const int index = playback.PlayerOf(peer);
    if (index < 0) continue;
    const Player& player = playback.scene().players[static_cast<std::size_t>(index)];
    if (!player.has_region) continue;
    const Vec2 margin(band, band);
    regions.push_back({Box(viewport, player.region_min, player.region_max),
                       Box(viewport, player.region_min - margin, player.region_max + margin),
                       PeerColour(peer), player.name});
  }
  return regions;
}

Rect Shared(const Rect& a, const Rect& b) {
  const float x0 = std::max(a.x, b.x), y0 = std::max(a.y, b.y);
  const float x1 = std::min(a.right(), b.right()), y1 = std::min(a.bottom(), b.bottom());
  return {x0, y0, std::max(0.0f, x1 - x0), std::max(0.0f, y1 - y0)};
}

/// Stripes between the region and the edge of its buffer zone, as far as the panel shows them.
void HatchBand(DrawList& list, const Region& region, const Rect& panel) {
  const Rect &in = region.inner, &out = region.outer;
  const Rect sides[4] = {{out.x, out.y, in.x - out.x, out.height},
                         {in.right(), out.y, out.right() - in.right(), out.height},
                         {in.x, out.y, in.width, in.y - out.y},
                         {in.x, in.bottom(), in.width, out.bottom() - in.bottom()}};
  // Each region's stripes lean its own way, so that two zones over each other read as two.
  const float lean = in.x + in.right() < panel.x + panel.right() ? 0.70710678f : -0.70710678f;
  for (const Rect& side : sides) {
    const Rect r = Shared(side, panel);
    if (r.width < 1 || r.height < 1) continue;
    list.Hatch({{r.x, r.y}, {r.right(), r.y}, {r.right(), r.bottom()}, {r.x, r.bottom()}},
               {in.x, in.y}, {0.70710678f, lean}, 14 * list.font().scale(),
               Faded(region.colour, 0.12f));
  }
}

}  // namespace

void DrawGrid(DrawList& list, const Viewport& viewport) {
  const float step = RoundUp(45 * list.font().scale() / viewport.px_per_m);
  const Vec2 low = viewport.ToWorld({viewport.panel.x, viewport.panel.bottom()});
  const Vec2 high = viewport.ToWorld({viewport.panel.right(), viewport.panel.y});
  const Line line{1, Faded(kGroundEdge, 0.13f), 0};
  for (float k = std::ceil(low.x() / step); k * step <= high.x(); ++k) {
    const float x = std::floor(viewport.ToPx({k * step, 0}).x()) + 0.5f;
    list.Stroke({{x, viewport.panel.y}, {x, viewport.panel.bottom()}}, false, line);
  }
  for (float k = std::ceil(low.y() / step); k * step <= high.y(); ++k) {
    const float y = std::floor(viewport.ToPx({0, k * step}).y()) + 0.5f;
    list.Stroke({{viewport.panel.x, y}, {viewport.panel.right(), y}}, false, line);
  }
}

void DrawRegions(DrawList& list, const Viewport& viewport, const Playback& playback) {
  const float scale = list.font().scale();
  // Opaque, because large translucent areas are the dearest thing on a page.
  const std::vector<Region> regions = RegionsOf(viewport, playback);
  for (const Region& region : regions)
    list.FillRect(Shared(region.inner, viewport.panel), Mix(kPanel, region.colour, 0.1f));
  for (const Region& region : regions) {
    HatchBand(list, region, viewport.panel);
    const Rect inner{region.inner.x + scale, region.inner.y + scale,
                     region.inner.width - 2 * scale, region.inner.height - 2 * scale};
    list.StrokeRect(inner, {1.5f * scale, Faded(region.colour, 0.85f), 0});
    if (region.outer.width > region.inner.width)
      list.StrokeRect(region.outer, {1.2f * scale, Faded(region.colour, 0.9f), 8 * scale});
  }
}

void DrawRegionNames(DrawList& list, const Viewport& viewport, const Playback& playback) {
  const float scale = list.font().scale();
  const float y = viewport.panel.bottom() - 10 * scale;
  const auto name = [&](float from, float to, const std::string& text, Colour colour) {
    from = std::max(from, viewport.panel.x);
    to = std::min(to, viewport.panel.right());
    if (to - from < list.font().Width(TextStyle::kSmall, text) + 12 * scale) return;
    list.Text((from + to) / 2, y, TextStyle::kSmall, text, Darker(colour), Align::kCentre);
  };
  const std::vector<Region> regions = RegionsOf(viewport, playback);
  for (const Region& region : regions) {
    // Where two zones overlap a name would stand on another: only the region's own part.
    float from = region.inner.x, to = region.inner.right();
    for (const Region& other : regions) {
      if (&other == &region) continue;
      if (other.outer.x <= from && other.outer.right() < to)
        from = std::max(from, other.outer.right());
      if (other.outer.right() >= to && other.outer.x > from) to = std::min(to, other.outer.x);
    }
    name(from, to, region.name + "'s region", region.colour);
    for (const Region& other : regions) {
      if (&other == &region || region.outer.width <= region.inner.width) continue;
      const bool to_the_right = other.inner.x >= region.inner.right() - 1;
      const bool to_the_left = other.inner.right() <= region.inner.x + 1;
      const std::string text = region.name + "'s buffer zone";
      if (to_the_right) name(region.inner.right(), region.outer.right(), text, region.colour);
      if (to_the_left) name(region.outer.x, region.inner.x, text, region.colour);
    }
  }
}

void DrawGround(DrawList& list, const Viewport& viewport, const Playback& playback, bool cull) {
  for (const BodyShapes& body : playback.anchored()) {
    if (cull && !viewport.Sees(body.start.position, body.reach)) continue;
    DrawBody(list, viewport, body, body.start, GroundLook());
  }
}

void DrawScaleBar(DrawList& list, const Viewport& viewport) {
  const float scale = list.font().scale();
  const float metres = RoundUp(60 * scale / viewport.px_per_m);
  const float right = std::round(viewport.panel.right() - 14 * scale) + 0.5f;
  const float left = right - std::round(metres * viewport.px_per_m);
  const float y = std::round(viewport.panel.y + 48 * scale) + 0.5f;
  const float tick = 3 * scale;
  const Line line{1.2f * scale, kFaintInk, 0};
  list.Stroke({{left, y}, {right, y}}, false, line);
  for (float x : {left, right}) list.Stroke({{x, y - tick}, {x, y + tick}}, false, line);
  std::string text = metres >= 1 ? std::to_string(static_cast<int>(metres + 0.5f)) + " m"
                                 : std::to_string(static_cast<int>(100 * metres + 0.5f)) + " cm";
  list.Text((left + right) / 2, y - 5 * scale, TextStyle::kSmall, text, kFaintInk,
            Align::kCentre);
}

}  // namespace seam
