#include "render/frame.h"

#include <algorithm>
#include <cmath>

#include "common/record/damage.h"
#include "render/canvas/palette.h"
#include "render/draw/draw_difference.h"
#include "render/draw/draw_hud.h"
#include "render/draw/draw_scene.h"
#include "render/panel_note.h"
#include "render/playback/format.h"
#include "render/playback/peer_colour.h"
#include "render/playback/peer_report.h"

namespace seam {
namespace {

std::string TitleOf(const Playback& playback) {
  return playback.scene().title.empty() ? playback.recording().room.scene_name
                                        : playback.scene().title;
}

Colour CurveColour(const Playback& playback, int peer) { return Darker(ColourOf(playback, peer)); }

/// Returns the text about the error in a panel's corner.
std::string ErrorText(const Panel& panel, double now_s) {
  const double tick = panel.playback->TickAt(now_s);
  const auto error = panel.playback->ErrorAt(panel.error_peer, tick);
  return error ? FormatLength(*error) : "";
}

float Aspect(const Page& page) {
  Vec2 size(0, 0);
  if (page.camera != nullptr) {
    for (int i = 0; i <= 8; ++i) {
      size += page.camera->At(page.from_s + (page.to_s - page.from_s) * i / 8).size();
    }
  } else {
    const auto& camera = page.panels.front().playback->scene().camera;
    size = camera.max - camera.min;
  }
  size = size.cwiseMax(1e-3f);
  return size.x() / size.y();
}

std::vector<Figure> Figures(const Page& page, double now_s) {
  const Playback& first = *page.panels.front().playback;
  const double tick = first.TickAt(now_s);
  std::vector<Figure> figures;
  figures.emplace_back("time", FormatTime(now_s));
  figures.emplace_back("tick", std::to_string(static_cast<std::int64_t>(std::floor(tick))));
  const PeerReport report = ReportOf(first.recording(), page.panels.front().peer, tick);
  if (report.rtt_us >= 0)
    figures.emplace_back("round trip", FormatNumber(report.rtt_us / 1e3, 0) + " ms");
  if (report.loss_percent >= 0)
    figures.emplace_back("loss", FormatNumber(report.loss_percent, 1) + " %");
  if (page.panels.size() == 1 && first.has_oracle())
    figures.emplace_back("error now", ErrorText(page.panels.front(), now_s));
  return figures;
}

constexpr float kInsetShare = 0.34f;  ///< of the panel's width and height

/// Returns the area of an inset: the upper corner that is farther from the enlarged place.
Rect InsetArea(const Rect& panel, const Vec2& shown_px, float scale) {
  const float width = kInsetShare * panel.width, height = kInsetShare * panel.height;
  const bool left = shown_px.x() > panel.x + panel.width / 2;
  const float x = left ? panel.x + 8 * scale : panel.right() - width - 8 * scale;
  return {std::round(x), std::round(panel.y + 28 * scale), std::round(width), std::round(height)};
}

/// Draws the contact enlarged; nothing where the panel already shows it about as large.
void DrawInset(DrawList& list, const Page& page, const Panel& panel, const Viewport& whole,
               const WorldLook& look, double now_s) {
  if (!page.inset || now_s < page.inset->from_s || now_s > page.inset->to_s) return;
  const WorldBox box = page.inset->camera.At(now_s);
  const float scale = list.font().scale();
  const Rect area = InsetArea(whole.panel, whole.ToPx(box.centre()), scale);
  const Viewport close = Fit(area, box.min, box.max);
  if (close.px_per_m < 1.3f * whole.px_per_m) return;
  const Vec2 a = whole.ToPx({box.min.x(), box.max.y()}), b = whole.ToPx({box.max.x(), box.min.y()});
  list.Clip(whole.panel);
  list.StrokeRect({a.x(), a.y(), b.x() - a.x(), b.y() - a.y()}, {1.2f * scale, kFaintInk, 0});
  list.NoClip();
  DrawWorld(list, close, *panel.playback, look);
  if (panel.over != nullptr) {
    DrawDifference(list, close, *panel.playback, *panel.over, panel.peer, now_s);
  }
  list.StrokeRect({area.x + 0.5f, area.y + 0.5f, area.width - 1, area.height - 1},
                  {1.6f * scale, kFaintInk, 0});
}

/// Returns the part of a panel's area for the world; below are the lines of the regions.
Rect WorldArea(const Panel& panel, const Rect& area, float scale) {
  return {area.x, area.y, area.width, area.height - RegionLinesHeight(*panel.playback, scale)};
}

/// Returns the texts in the corners of a panel: caption, error or distance, note.
CornerTexts CornersOf(const Page& page, const Panel& panel, double now_s) {
  const std::string error = page.panels.size() > 1 ? ErrorText(panel, now_s) : "";
  std::string right = error.empty() ? "" : "error " + error;
  if (panel.over != nullptr) {
    const double apart = ApartOf(*panel.playback, *panel.over, panel.peer, now_s);
    right = apart < 0 ? "" : "apart " + FormatLength(apart) + " RMS";
  }
  return {panel.caption, right, panel.swatch, TextOf(NoteOf(panel, now_s))};
}

void DrawPanelWorld(DrawList& list, const Page& page, const Panel& panel, const Rect& area,
                    double now_s) {
  const Rect world = WorldArea(panel, area, list.font().scale());
  const Viewport viewport = ViewportOf(page, panel, world, now_s);
  WorldLook look = page.look;
  look.texts = CornerAreas(list, world, CornersOf(page, panel, now_s));
  look.peer = panel.peer;
  look.tick = panel.playback->TickAt(now_s);
  DrawWorld(list, viewport, *panel.playback, look);
  if (panel.over != nullptr) {
    DrawDifference(list, viewport, *panel.playback, *panel.over, panel.peer, now_s);
  }
  DrawInset(list, page, panel, viewport, look, now_s);
}

void DrawPanelFrame(DrawList& list, const Page& page, const Panel& panel, const Rect& area,
                    double now_s) {
  const Rect world = WorldArea(panel, area, list.font().scale());
  const Viewport viewport = ViewportOf(page, panel, world, now_s);
  DrawRegionLines(list, viewport, *panel.playback, world.bottom());
  DrawCorners(list, world, CornersOf(page, panel, now_s));
  const Rect frame{world.x + 0.5f, world.y + 0.5f, world.width - 1, world.height - 1};
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

/// Layout of a page.
struct Areas {
  Areas(const Page& page, float scale) {
    const float margin = 18 * scale, width = static_cast<float>(page.width_px) - 2 * margin;
    const float top = 58 * scale, below = 26 * scale, end = 122 * scale;
    const auto height = static_cast<float>(page.height_px);
    header = {margin, 6 * scale, width, top};
    const Rect middle{margin, top, width, height - top - below - end};
    panels = Tile(middle, static_cast<int>(page.panels.size()), Aspect(page), 8 * scale,
                  RegionLinesHeight(*page.panels.front().playback, scale));
    legend = {margin, middle.bottom() + 2 * scale, width, below};
    strip = {margin, height - end + 2 * scale, width, end - 6 * scale};
  }
  Rect header, legend, strip;
  std::vector<Rect> panels;
};

void DrawPanels(DrawList& list, const Page& page, const Areas& areas, double now_s) {
  // Worlds first: the canvas is fast with large areas if nothing was drawn under them.
  for (std::size_t i = 0; i < page.panels.size(); ++i)
    DrawPanelWorld(list, page, page.panels[i], areas.panels[i], now_s);
  for (std::size_t i = 0; i < page.panels.size(); ++i)
    DrawPanelFrame(list, page, page.panels[i], areas.panels[i], now_s);
}

void DrawPageLegend(DrawList& list, const Rect& area, const Page& page) {
  const Playback& first = *page.panels.front().playback;
  DrawLegend(list, area, first, page.look, !first.recording().impacts.empty());
}

void DrawStillAround(DrawList& list, const Page& page, const Areas& areas) {
  // Room for the greatest number of figures, so that the title keeps its length.
  DrawHeader(list, areas.header, page.title, page.subtitle, Figures(page, page.to_s).size());
  DrawPageLegend(list, areas.legend, page);
  DrawStrip(list, areas.strip, page.curves, {page.strip_from_s, page.strip_to_s, page.to_s});
}

void DrawNowAround(DrawList& list, const Page& page, const Areas& areas, double now_s) {
  DrawFigures(list, areas.header, Figures(page, now_s));
  DrawStripNow(list, areas.strip, page.curves, {page.strip_from_s, page.strip_to_s, now_s});
}

constexpr double kInsetBefore_s = 0.5, kInsetAfter_s = 1;  ///< about the contact

/// Returns a part of a subtitle: what a recording lacks; "" if it is whole.
std::string DamageOfRun(const Playback& playback, const std::string& of) {
  const std::string note = DamageNote(playback.recording());
  return note.empty() ? "" : "damage" + of + ": " + note + "  ·  ";
}

}  // namespace

std::string DamageText(const std::vector<Playback>& playbacks) {
  std::string text;
  for (const Playback& run : playbacks)
    text += DamageOfRun(run, playbacks.size() > 1 ? " of " + run.Label() : "");
  return text;
}

void SetCamera(const CameraWish& wish, const std::vector<Playback>& playbacks, Page* page) {
  std::vector<CameraView> views;
  for (const Panel& panel : page->panels) views.push_back({panel.playback, panel.peer});
  page->camera =
      std::make_shared<const CameraPath>(views, wish, page->strip_from_s, page->strip_to_s);
  page->inset.reset();
  if (!wish.bodies.empty()) return;
  const std::optional<ShownMoment> contact = ContactMoment(playbacks);
  if (!contact || contact->bodies.empty()) return;
  const double from_s = contact->s - kInsetBefore_s, to_s = contact->s + kInsetAfter_s;
  if (from_s > page->to_s || to_s < page->from_s) return;
  CameraWish close;
  close.bodies = contact->bodies;
  page->inset = Inset{from_s, to_s, CameraPath(views, close, from_s, to_s)};
}

Viewport ViewportOf(const Page& page, const Panel& panel, const Rect& area, double now_s) {
  if (page.camera == nullptr) {
    return SceneViewport(area, *panel.playback, panel.peer, panel.playback->TickAt(now_s));
  }
  const WorldBox box = page.camera->At(now_s);
  return Fit(area, box.min, box.max);
}

Page MakePage(const Playback& playback, int peer) {
  Page page;
  page.title = TitleOf(playback);
  page.subtitle = DamageOfRun(playback, "") + RunDescription(playback);
  page.to_s = page.strip_to_s = playback.last_s();
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
    page.curves.push_back(
        CurveOf(playback, p, CurveColour(playback, p), "view of " + playback.PeerName(p)));
  return page;
}

Page MakeComparison(const std::vector<Playback>& playbacks, int peer) {
  Page page;
  const Playback& first = playbacks.front();
  page.title = TitleOf(first);
  const Room& room = first.recording().room;
  page.subtitle = DamageText(playbacks) + std::to_string(playbacks.size()) +
                  " runs in step, view of " + first.PeerName(first.PeerOr(peer));
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
  page.strip_from_s = page.from_s;
  page.strip_to_s = page.to_s;
  return page;
}

Page MakeDifference(const std::vector<Playback>& playbacks, int peer) {
  Page page = MakeComparison(playbacks, peer);
  Panel& panel = page.panels.front();
  panel.over = &playbacks.at(1);
  panel.caption = page.panels[1].caption + " over " + panel.caption + " (pale)";
  panel.swatch.a = 0;
  page.panels.resize(1);
  page.subtitle = DamageText(playbacks) + "difference of two runs, view of " +
                  playbacks.front().PeerName(playbacks.front().PeerOr(peer));
  const std::string& network = playbacks.front().recording().room.impair;
  if (!network.empty()) page.subtitle += "  ·  network " + network;
  return page;
}

void DrawStill(DrawList& list, const Page& page) {
  list.Begin(page.width_px, page.height_px);
  DrawStillAround(list, page, Areas(page, list.font().scale()));
}

void DrawMoving(DrawList& list, const Page& page, double now_s) {
  list.Begin(page.width_px, page.height_px);
  const Areas areas(page, list.font().scale());
  DrawPanels(list, page, areas, now_s);
  DrawNowAround(list, page, areas, now_s);
}

void DrawPage(DrawList& list, const Page& page, double now_s) {
  list.Begin(page.width_px, page.height_px);
  const Areas areas(page, list.font().scale());
  DrawPanels(list, page, areas, now_s);
  DrawStillAround(list, page, areas);
  DrawNowAround(list, page, areas, now_s);
}

void DrawSheet(DrawList& list, const Page& page, int moments) {
  list.Begin(page.width_px, page.height_px);
  const float scale = list.font().scale(), margin = 18 * scale, header = 58 * scale;
  const float legend = 26 * scale;
  const float width = static_cast<float>(page.width_px) - 2 * margin;
  std::string text =
      page.subtitle + "  ·  " + FormatTime(page.from_s) + " to " + FormatTime(page.to_s);
  if (page.panels.size() == 1) text = page.panels.front().caption + "  ·  " + text;
  DrawHeader(list, {margin, 6 * scale, width, header}, page.title, text, 0);
  const Rect area{margin, header, width, static_cast<float>(page.height_px) - header - legend};
  DrawPageLegend(list, {margin, area.bottom(), width, legend}, page);
  const float lines = RegionLinesHeight(*page.panels.front().playback, scale), gap = 6 * scale;
  const int runs = static_cast<int>(page.panels.size());
  const float aspect = Aspect(page);
  int moment = 0;
  for (const Rect& cell : Tile(area, moments, aspect * static_cast<float>(runs), gap, lines)) {
    const double now_s =
        page.from_s + (page.to_s - page.from_s) * moment++ / std::max(1, moments - 1);
    std::size_t of = 0;
    for (const Rect& place : Tile(cell, runs, aspect, gap, lines)) {
      Panel panel = page.panels[of++];
      panel.caption = FormatTime(now_s) + (runs > 1 ? "  " + panel.caption : "");
      DrawPanelWorld(list, page, panel, place, now_s);
      DrawPanelFrame(list, page, panel, place, now_s);
    }
  }
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
