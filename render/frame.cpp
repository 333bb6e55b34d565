#include "render/frame.h"

#include <algorithm>
#include <cmath>

#include "render/canvas/palette.h"
#include "render/draw/draw_hud.h"
#include "render/draw/draw_world.h"
#include "render/playback/format.h"

namespace seam {
namespace {

std::string TitleOf(const Playback& playback) {
  return playback.scene().title.empty() ? playback.recording().room.scene_name
                                        : playback.scene().title;
}

Colour CurveColour(int peer) { return Darker(PeerColour(peer)); }

std::string ErrorText(const Panel& panel, double now_s) {
  const double tick = panel.playback->TickAt(now_s);
  const auto error = panel.playback->ErrorAt(panel.error_peer, tick);
  return error ? FormatLength(*error) : "";
}

float Aspect(const Page& page) {
  const auto& camera = page.panels.front().playback->scene().camera;
  const Vec2 size = (camera.max - camera.min).cwiseMax(1e-3f);
  return size.x() / size.y();
}

std::vector<Figure> Figures(const Page& page, double now_s) {
  const Playback& first = *page.panels.front().playback;
  const double tick = first.TickAt(now_s);
  std::vector<Figure> figures;
  figures.emplace_back("time", FormatTime(now_s));
  figures.emplace_back("tick", std::to_string(static_cast<std::int64_t>(std::floor(tick))));
  const std::int32_t rtt_us = first.RoundTripUs(page.panels.front().peer, tick);
  if (rtt_us >= 0) figures.emplace_back("round trip", FormatNumber(rtt_us / 1e3, 0) + " ms");
  if (page.panels.size() == 1 && first.has_oracle())
    figures.emplace_back("error now", ErrorText(page.panels.front(), now_s));
  return figures;
}

void DrawPanel(DrawList& list, const Page& page, const Panel& panel, const Rect& area,
               double now_s) {
  const double tick = panel.playback->TickAt(now_s);
  const Viewport viewport = SceneViewport(area, *panel.playback, panel.peer, tick);
  WorldLook look;
  look.peer = panel.peer;
  look.tick = tick;
  look.cull = page.cull;
  DrawWorld(list, viewport, *panel.playback, look);
  const std::string error = page.panels.size() > 1 ? ErrorText(panel, now_s) : "";
  DrawCaption(list, area, panel.caption, error.empty() ? "" : "error " + error, panel.swatch);
  const Rect frame{area.x + 0.5f, area.y + 0.5f, area.width - 1, area.height - 1};
  list.StrokeRect(frame, {1, kFrame, 0});
}

Curve CurveOf(const Playback& playback, int peer, Colour colour, const std::string& label) {
  Curve curve;
  curve.errors_m = &playback.ErrorByTick(peer);
  curve.first_tick = playback.ErrorFirstTick();
  curve.tick_hz = playback.tick_hz();
  curve.colour = colour;
  curve.label = label;
  return curve;
}

}  // namespace

Page MakePage(const Playback& playback, int peer) {
  Page page;
  page.title = TitleOf(playback);
  page.subtitle = RunDescription(playback);
  page.to_s = playback.last_s();
  const std::vector<int> peers = playback.peers();
  const std::vector<int> shown = peer == kViewAll ? peers : std::vector<int>{playback.PeerOr(peer)};
  for (int p : shown)
    page.panels.push_back({&playback, p, p, "view of " + playback.PeerName(p), {0, 0, 0, 0}});
  if (!playback.has_oracle()) return page;
  if (peer != kViewAll && peers.size() > 1) {
    page.curves.push_back(CurveOf(playback, -1, Mix(kFaintInk, kPaper, 0.4f), "all views"));
    page.curves.back().bold = false;
  }
  for (int p : shown)
    page.curves.push_back(CurveOf(playback, p, CurveColour(p), "view of " + playback.PeerName(p)));
  return page;
}

Page MakeComparison(const std::vector<Playback>& playbacks, int peer) {
  Page page;
  const Playback& first = playbacks.front();
  page.title = TitleOf(first);
  const Room& room = first.recording().room;
  page.subtitle = std::to_string(playbacks.size()) + " runs in step, view of " +
                  first.PeerName(first.PeerOr(peer));
  if (!room.impair.empty()) page.subtitle += "  ·  network " + room.impair;
  page.from_s = first.first_s();
  page.to_s = first.last_s();
  int run = 0;
  for (const Playback& playback : playbacks) {
    const Colour colour = RunColour(run++);
    page.panels.push_back({&playback, playback.PeerOr(peer), -1, playback.Label(), colour});
    page.from_s = std::min(page.from_s, playback.first_s());
    page.to_s = std::max(page.to_s, playback.last_s());
    if (playback.has_oracle())
      page.curves.push_back(CurveOf(playback, -1, colour, playback.Label()));
  }
  return page;
}

void DrawPage(DrawList& list, const Page& page, double now_s) {
  list.Begin(page.width_px, page.height_px);
  const float scale = list.font().scale();
  const float margin = 18 * scale;
  const float width = static_cast<float>(page.width_px) - 2 * margin;
  const float height = static_cast<float>(page.height_px);
  const float header = 58 * scale, legend = 26 * scale, strip = 122 * scale;
  DrawHeader(list, {margin, 6 * scale, width, header}, page.title, page.subtitle,
             Figures(page, now_s));
  const Rect middle{margin, header, width, height - header - legend - strip};
  const std::vector<Rect> areas =
      Tile(middle, static_cast<int>(page.panels.size()), Aspect(page), 8 * scale);
  for (std::size_t i = 0; i < page.panels.size(); ++i)
    DrawPanel(list, page, page.panels[i], areas[i], now_s);
  const Playback& first = *page.panels.front().playback;
  DrawLegend(list, {margin, middle.bottom() + 2 * scale, width, legend}, first,
             !first.recording().impacts.empty());
  DrawStrip(list, {margin, height - strip + 2 * scale, width, strip - 6 * scale}, page.curves,
            {page.from_s, page.to_s, now_s});
}

std::string TextsOf(const std::vector<Playback>& playbacks) {
  std::string texts;
  for (const Playback& playback : playbacks) {
    texts += TitleOf(playback) + RunDescription(playback);
    for (const Player& player : playback.scene().players) texts += player.name;
  }
  return texts;
}

float ScaleOf(int width_px, int height_px) {
  const auto width = static_cast<float>(width_px), height = static_cast<float>(height_px);
  // Small pages get relatively larger letters, as far as the legend fits.
  const float readable = std::min({0.85f, width / 1090, height / 620});
  return std::max(std::min(width / 1280, height / 720), readable);
}

}  // namespace seam
