#include "render/strobe.h"

#include <algorithm>
#include <cmath>

#include "render/canvas/palette.h"
#include "render/draw/draw_body.h"
#include "render/draw/draw_ghosts.h"
#include "render/draw/draw_hud.h"
#include "render/draw/draw_joints.h"
#include "render/draw/draw_scene.h"
#include "render/playback/format.h"
#include "render/playback/peer_colour.h"
#include "render/strobe_layout.h"

namespace seam {
namespace {

constexpr float kGhostWidth = 0.9f;  ///< px; thin, since many ghosts overlap

std::vector<double> Exposures(const StrobePlan& plan) {
  std::vector<double> times;
  for (int i = 0; plan.from_s + i * plan.step_s <= plan.to_s + 1e-9; ++i)
    times.push_back(plan.from_s + i * plan.step_s);
  return times;
}

/// Returns the opacity of an exposure: the last one is full, the first one faint.
float Opacity(std::size_t exposure, std::size_t count) {
  if (count < 2) return 1;
  const float share = static_cast<float>(exposure) / static_cast<float>(count - 1);
  return 0.16f + 0.84f * share * share;
}

/// Draws one exposure. A body that does not move until the next exposure is drawn only there.
void DrawExposure(DrawList& list, const Viewport& viewport, const Playback& playback, int peer,
                  const std::vector<double>& times, std::size_t i) {
  const Moment now = playback.MomentAt(peer, playback.TickAt(times[i]));
  const bool last = i + 1 == times.size();
  const Moment next = last ? now : playback.MomentAt(peer, playback.TickAt(times[i + 1]));
  DrawRods(list, viewport, playback, now, 0.8f * Opacity(i, times.size()));
  const auto revision = playback.RevisionOf(now);
  for (const BodyShapes& body : revision->moving) {
    const auto shown = playback.Find(now, body.id);
    if (!shown || !viewport.Sees(shown->pose.position, body.reach)) continue;
    const auto then = playback.Find(next, body.id);
    if (!last && then && PixelsApart(viewport, body, shown->pose, then->pose) < 1.5f) continue;
    BodyLook look = LookOf(ColourOf(playback, shown->authority), shown->role);
    look.opacity = Opacity(i, times.size());
    DrawBody(list, viewport, body, shown->pose, look);
  }
}

/// With more bodies than this only the last exposure has ghosts, to avoid clutter.
constexpr std::size_t kFewBodies = 12;

/// Draws the oracle's poses at the same moment, where they differ from the view's.
void DrawGhosts(DrawList& list, const Viewport& viewport, const Playback& playback, int peer,
                const std::vector<double>& times, std::size_t i) {
  if (i + 1 < times.size() && playback.moving().size() > kFewBodies) return;
  const double tick = playback.TickAt(times[i]);
  const Moment now = playback.MomentAt(peer, tick);
  const float opacity = 0.2f + 0.7f * Opacity(i, times.size());
  VisitTruth(playback, *playback.RevisionOf(now), now,
             [&](const BodyShapes& body, const Pose& truth, const std::optional<Pose>& shown) {
               if (!viewport.Sees(truth.position, body.reach)) return;
               if (shown && PixelsApart(viewport, body, *shown, truth) < 2) return;
               DrawGhost(list, viewport, body, truth, opacity, kGhostWidth);
             });
}

void DrawPanel(DrawList& list, const Rect& area, const Playback& playback, int peer,
               const StrobePlan& plan) {
  const Viewport viewport = Fit(area, plan.min, plan.max);
  const std::vector<double> times = Exposures(plan);
  list.Clip(area);
  DrawRegions(list, viewport, playback, Moment{});
  DrawWaters(list, viewport, playback);
  const Moment last = playback.MomentAt(peer, playback.TickAt(times.back()));
  DrawGround(list, viewport, playback, *playback.RevisionOf(last), last.tick, true);
  for (std::size_t i = 0; i < times.size(); ++i)
    DrawExposure(list, viewport, playback, peer, times, i);
  DrawSurfaces(list, viewport, playback);
  for (std::size_t i = 0; i < times.size(); ++i)
    DrawGhosts(list, viewport, playback, peer, times, i);
  list.NoClip();
  list.StrokeRect({area.x + 0.5f, area.y + 0.5f, area.width - 1, area.height - 1}, {1, kFrame, 0});
}

/// Draws mode, reconciler and the run's key figures, left of its row.
void DrawRowLabel(DrawList& list, const Rect& area, const Playback& playback) {
  const float scale = list.font().scale();
  const Room& room = playback.recording().room;
  float y = area.y + 16 * scale;
  const std::string method = room.reconcile.empty() ? room.mode : room.reconcile;
  const std::string predicts = room.predict.empty() ? "" : "/" + room.predict;
  list.Text(area.x, y, TextStyle::kNumber, method + predicts, kInk);
  y += 16 * scale;
  const std::string about = playback.policy().about();
  list.Text(area.x, y, TextStyle::kBody, about.empty() ? "mode " + room.mode : about, kFaintInk);
  if (!playback.apart().empty()) {
    y += 16 * scale;
    list.Text(area.x, y, TextStyle::kBody, playback.apart(), kInk);
  }
  y += 4 * scale;
  const auto figure = [&](const std::string& name, const std::string& value) {
    y += 16 * scale;
    list.Text(area.x, y, TextStyle::kBody, name, kFaintInk);
    list.Text(area.right(), y, TextStyle::kStrong, value, kInk, Align::kRight);
  };
  if (!playback.measures() || playback.policy().IsOracle()) return;
  const Measures& measures = *playback.measures();
  if (measures.rebound) figure("rebound", FormatNumber(*measures.rebound, 2));
  figure("error RMS", FormatLength(measures.shown_error_rms_m));
  figure("error max", FormatLength(measures.shown_error_max_m));
}

}  // namespace

float StrobeScale(int width_px) { return static_cast<float>(width_px) / 1280; }

StrobeLayout LayOutStrobe(const StrobePlan& plan, int rows) {
  StrobeLayout layout;
  layout.scale = StrobeScale(plan.width_px);
  layout.margin = 18 * layout.scale;
  layout.header = 80 * layout.scale;
  layout.footer = 34 * layout.scale;
  layout.labels = 158 * layout.scale;
  layout.gap = 8 * layout.scale;
  const auto columns = static_cast<float>(plan.peers.size());
  const auto row_count = static_cast<float>(rows);
  layout.panel_width = (static_cast<float>(plan.width_px) - 2 * layout.margin - layout.labels -
                        (columns - 1) * layout.gap) /
                       columns;
  layout.panel_height = (static_cast<float>(plan.height_px) - layout.header - layout.footer -
                         (row_count - 1) * layout.gap) /
                        row_count;
  return layout;
}

int StrobeHeight(const StrobePlan& plan, int rows) {
  const StrobeLayout layout = LayOutStrobe(plan, rows);
  const Vec2 size = plan.max - plan.min;
  const float panel =
      std::clamp(layout.panel_width * size.y() / size.x(), 96 * layout.scale, 190 * layout.scale);
  const float count = static_cast<float>(rows);
  return static_cast<int>(std::lround(layout.header + layout.footer + count * std::round(panel) +
                                      (count - 1) * layout.gap));
}

void DrawStrobe(DrawList& list, const std::vector<Playback>& playbacks, const StrobePlan& plan) {
  const StrobeLayout layout = LayOutStrobe(plan, static_cast<int>(playbacks.size()));
  const float scale = layout.scale;
  list.Begin(plan.width_px, plan.height_px);
  const Playback& last = playbacks.back();
  const Playback& first = playbacks.front();
  const Room& room = last.recording().room;
  std::string subtitle = DamageText(playbacks) + "exposures every " + FormatTime(plan.step_s) +
                         " from " + FormatTime(plan.from_s) + " to " + FormatTime(plan.to_s) +
                         ", older ones fainter";
  if (!room.impair.empty()) subtitle += "  ·  network " + room.impair;
  const std::string title = first.scene().title.empty() ? room.scene_name : first.scene().title;
  const float width = static_cast<float>(plan.width_px) - 2 * layout.margin;
  DrawHeader(list, {layout.margin, 6 * scale, width, layout.header}, title, subtitle, 0);
  for (std::size_t column = 0; column < plan.peers.size(); ++column) {
    const float x = layout.margin + layout.labels +
                    static_cast<float>(column) * (layout.panel_width + layout.gap);
    const std::string name = last.PeerName(plan.peers[column]);
    list.Text(x, layout.header - 7 * scale, TextStyle::kStrong, "as " + name + " sees it", kInk);
    for (std::size_t row = 0; row < playbacks.size(); ++row) {
      const float y = layout.header + static_cast<float>(row) * (layout.panel_height + layout.gap);
      const Rect area{std::round(x), std::round(y), std::round(layout.panel_width),
                      std::round(layout.panel_height)};
      const Playback& playback = playbacks[row];
      if (column == 0)
        DrawRowLabel(list, {layout.margin, y, layout.labels - 18 * scale, area.height}, playback);
      DrawPanel(list, area, playback, playback.PeerOr(plan.peers[column]), plan);
    }
  }
  const float below = static_cast<float>(plan.height_px) - layout.footer;
  DrawLegend(list, {layout.margin, below + 4 * scale, width, layout.footer - 8 * scale}, last, {},
             false);
}

}  // namespace seam
