#include "render/draw/draw_scene.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/scene/planner/planner_rules.h"
#include "common/scene/water.h"
#include "render/canvas/palette.h"
#include "render/draw/draw_body.h"
#include "render/draw/draw_bricks.h"
#include "render/playback/held_regions.h"
#include "render/playback/peer_colour.h"

namespace seam {
namespace {

/// Returns the smallest of 1, 2, 5 times ten to the n that is at least `least`.
float RoundUp(float least) {
  const float decade = std::pow(10.0f, std::floor(std::log10(least)));
  for (float step : {1.0f, 2.0f, 5.0f})
    if (step * decade >= least * 0.999f) return step * decade;
  return 10 * decade;
}

struct Region {
  Rect inner, outer;  ///< px; the region, and with its buffer zone
  Colour colour;
  std::string name;
};

Rect Box(const Viewport& viewport, const Vec2& min, const Vec2& max) {
  const Vec2 a = viewport.ToPx({min.x(), max.y()}), b = viewport.ToPx({max.x(), min.y()});
  return {a.x(), a.y(), b.x() - a.x(), b.y() - a.y()};
}

std::vector<Region> FixedRegions(const Viewport& viewport, const Playback& playback) {
  std::vector<Region> regions;
  if (!playback.policy().PlansAuthority()) return regions;
  if (playback.scene().planner->given) return regions;  // regions do not decide
  const float band = playback.policy().PlansFollowers() ? playback.scene().buffer_m : 0;
  for (int peer : playback.peers()) {
    const int index = playback.PlayerOf(peer);
    if (index < 0) continue;
    const Player& player = playback.scene().players[static_cast<std::size_t>(index)];
    if (!player.has_region) continue;
    const Vec2 margin(band, band);
    regions.push_back({Box(viewport, player.region_min, player.region_max),
                       Box(viewport, player.region_min - margin, player.region_max + margin),
                       ColourOf(playback, peer), player.name});
  }
  return regions;
}

/// Returns the regions fixed by the scene, or those that follow the moment's authority.
std::vector<Region> RegionsOf(const Viewport& viewport, const Playback& playback,
                              const Moment& moment) {
  std::vector<Region> regions = FixedRegions(viewport, playback);
  for (const HeldRegion& held : HeldRegions(playback, moment)) {
    const Rect box = Box(viewport, held.min, held.max);
    regions.push_back({box, box, ColourOf(playback, held.peer), playback.PeerName(held.peer)});
  }
  return regions;
}

Rect Shared(const Rect& a, const Rect& b) {
  const float x0 = std::max(a.x, b.x), y0 = std::max(a.y, b.y);
  const float x1 = std::min(a.right(), b.right()), y1 = std::min(a.bottom(), b.bottom());
  return {x0, y0, std::max(0.0f, x1 - x0), std::max(0.0f, y1 - y0)};
}

/// Draws a region's extent as a line, and its buffer zone as a thinner one on both sides.
void DrawExtent(DrawList& list, const Region& region, const Rect& row) {
  const Rect zone = Shared({region.outer.x, row.y, region.outer.width, row.height}, row);
  const Rect own = Shared({region.inner.x, row.y, region.inner.width, row.height}, row);
  const float middle = row.y + row.height / 2;
  if (zone.width > own.width)
    list.Stroke({{zone.x, middle}, {zone.right(), middle}}, false,
                {std::max(1.0f, row.height / 4), region.colour, row.height * 1.5f});
  if (own.width > 0) list.FillRect(own, region.colour);
}

constexpr float kTint = 0.22f, kVeil = 0.16f;
/// Distance between arrows of the flow, px at scale 1.
constexpr float kArrowsApart = 130;

/// Returns the visible part of a water; without area if none.
Rect OnPanel(const Viewport& viewport, const Water& water) {
  const Vec2 a = viewport.ToPx({water.min.x(), water.max.y()});
  const Vec2 b = viewport.ToPx({water.max.x(), water.min.y()});
  const Rect& panel = viewport.panel;
  const float x0 = std::max(a.x(), panel.x), x1 = std::min(b.x(), panel.right());
  const float y0 = std::max(a.y(), panel.y), y1 = std::min(b.y(), panel.bottom());
  return {x0, y0, std::max(0.0f, x1 - x0), std::max(0.0f, y1 - y0)};
}

bool HasArea(const Rect& rect) { return rect.width > 0 && rect.height > 0; }

/// Draws pale arrows along the flow, fixed to the world, longer for a faster flow.
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

/// Draws the grid's lines within `area`, on whole pixels, opaque, for a ground of this colour.
void DrawGrid(DrawList& list, const Viewport& viewport, const Rect& area, Colour ground) {
  const float step = RoundUp(45 * list.font().scale() / viewport.px_per_m);
  const Vec2 low = viewport.ToWorld({viewport.panel.x, viewport.panel.bottom()});
  const Vec2 high = viewport.ToWorld({viewport.panel.right(), viewport.panel.y});
  const Colour colour = Mix(ground, kGroundEdge, 0.13f);
  for (float k = std::ceil(low.x() / step); k * step <= high.x(); ++k) {
    const float x = std::floor(viewport.ToPx({k * step, 0}).x());
    list.FillUnder(Shared({x, area.y, 1, area.height}, area), colour);
  }
  for (float k = std::ceil(low.y() / step); k * step <= high.y(); ++k) {
    const float y = std::floor(viewport.ToPx({0, k * step}).y());
    list.FillUnder(Shared({area.x, y, area.width, 1}, area), colour);
  }
}

/// Draws the panel's background, the regions' tints and the grid, all opaque, because opaque areas
/// are written directly to memory. A region's tint covers the grid below, so each has its own grid.
void DrawFlats(DrawList& list, const Viewport& viewport, const std::vector<Region>& regions) {
  list.FillUnder(viewport.panel, kPanel);
  DrawGrid(list, viewport, viewport.panel, kPanel);
  for (const Region& region : regions) {
    const Rect area = Shared(region.inner, viewport.panel);
    const Colour ground = Mix(kPanel, region.colour, 0.1f);
    list.FillUnder(area, ground);
    DrawGrid(list, viewport, area, ground);
  }
}

}  // namespace

void DrawRegions(DrawList& list, const Viewport& viewport, const Playback& playback,
                 const Moment& moment) {
  const float scale = list.font().scale();
  const std::vector<Region> regions = RegionsOf(viewport, playback, moment);
  DrawFlats(list, viewport, regions);
  // A region may be kilometres wide; the rasteriser is slow with shapes far outside the panel.
  const Rect& panel = viewport.panel;
  const float beyond = 10 * scale;
  const Rect near{panel.x - beyond, panel.y - beyond, panel.width + 2 * beyond,
                  panel.height + 2 * beyond};
  for (const Region& region : regions) {
    const Rect inner{region.inner.x + scale, region.inner.y + scale, region.inner.width - 2 * scale,
                     region.inner.height - 2 * scale};
    if (HasArea(Shared(inner, near)))
      list.StrokeRect(Shared(inner, near), {1.5f * scale, Faded(region.colour, 0.85f), 0});
    if (region.outer.width > region.inner.width && HasArea(Shared(region.outer, near))) {
      list.StrokeRect(Shared(region.outer, near),
                      {1.2f * scale, Faded(region.colour, 0.9f), 8 * scale});
    }
  }
  list.EndDashes();
}

float RegionLinesHeight(const Playback& playback, float scale) {
  const Viewport any;
  const auto count =
      static_cast<float>(std::min<std::size_t>(FixedRegions(any, playback).size(), 8));
  return count == 0 ? 0 : std::round((2 + 5 * count) * scale);
}

void DrawRegionLines(DrawList& list, const Viewport& viewport, const Playback& playback, float y) {
  const float scale = list.font().scale();
  const std::vector<Region> regions = FixedRegions(viewport, playback);
  y += 2 * scale;
  for (std::size_t i = 0; i < regions.size() && i < 8; ++i) {
    DrawExtent(list, regions[i],
               {viewport.panel.x, std::round(y), viewport.panel.width, std::round(3 * scale)});
    y += 5 * scale;
  }
  list.EndDashes();
}

void DrawGround(DrawList& list, const Viewport& viewport, const Playback& playback,
                const DrawnRevision& revision, double tick, bool cull) {
  for (const BodyShapes& body : revision.anchored) {
    const Pose pose = playback.Anchored(body, tick);
    if (cull && !viewport.Sees(pose.position, body.reach)) continue;
    DrawBody(list, viewport, body, pose, GroundLook());
  }
  if (revision.bricks != nullptr) DrawBricks(list, viewport, *revision.bricks);
}

Rect ScaleBarArea(const DrawList& list, const Viewport& viewport) {
  const float scale = list.font().scale();
  const float width = std::round(RoundUp(60 * scale / viewport.px_per_m) * viewport.px_per_m);
  const float right = std::round(viewport.panel.right() - 14 * scale) + 0.5f;
  const float bottom = std::round(viewport.panel.bottom() - 8 * scale) + 0.5f;
  return {right - width, bottom - 14 * scale, width, 14 * scale};
}

void DrawScaleBar(DrawList& list, const Viewport& viewport) {
  const float scale = list.font().scale();
  const float metres = RoundUp(60 * scale / viewport.px_per_m);
  const Rect area = ScaleBarArea(list, viewport);
  const float left = area.x, right = area.right(), y = area.bottom();
  const float tick = 3 * scale;
  const Line line{1.2f * scale, kFaintInk, 0};
  list.Stroke({{left, y}, {right, y}}, false, line);
  for (float x : {left, right}) list.Stroke({{x, y - tick}, {x, y + tick}}, false, line);
  std::string text = metres >= 1 ? std::to_string(static_cast<int>(metres + 0.5f)) + " m"
                                 : std::to_string(static_cast<int>(100 * metres + 0.5f)) + " cm";
  const float wide = list.font().Width(TextStyle::kSmall, text) + 6 * scale;
  list.FillRect({std::round((left + right - wide) / 2), y - 14 * scale, wide, 12 * scale},
                Faded(kPanel, 0.75f));
  list.Text((left + right) / 2, y - 5 * scale, TextStyle::kSmall, text, kFaintInk, Align::kCentre);
}

void DrawWaters(DrawList& list, const Viewport& viewport, const Playback& playback) {
  for (const Water& water : playback.scene().waters) {
    const Rect area = OnPanel(viewport, water);
    if (!HasArea(area)) continue;
    list.FillRect(area, Faded(kWater, kTint));
    DrawFlow(list, viewport, water, area);
  }
}

void DrawSurfaces(DrawList& list, const Viewport& viewport, const Playback& playback) {
  for (const Water& water : playback.scene().waters) {
    const Rect area = OnPanel(viewport, water);
    if (!HasArea(area)) continue;
    list.FillRect(area, Faded(kWater, kVeil));
    const float level = viewport.ToPx(water.max).y();
    if (level < viewport.panel.y) continue;
    list.Stroke({{area.x, level}, {area.right(), level}}, false,
                {1.5f * list.font().scale(), Faded(kWaterLine, 0.8f), 0});
  }
}

}  // namespace seam
