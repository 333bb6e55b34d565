#include "render/draw/draw_world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "common/scene/character.h"
#include "render/canvas/figure.h"
#include "render/canvas/palette.h"
#include "render/draw/draw_body.h"
#include "render/draw/draw_ghosts.h"
#include "render/draw/draw_joints.h"
#include "render/draw/draw_rules.h"
#include "render/draw/draw_scene.h"
#include "render/playback/marks.h"

namespace seam {
namespace {

constexpr double kTrailSeconds = 1.2;
constexpr int kTrailPoints = 36;
constexpr double kImpactSeconds = 0.5;  ///< how long a mark stays

struct Seen {
  const BodyShapes* body = nullptr;
  Shown shown;
};

/// -1: no character's.
int CharacterOf(const Seen& one) { return one.body->outlines[0].figure.character; }

/// A character's bodies one after the other, far limbs first; all else stays as it is.
void SortFigures(std::vector<Seen>* seen) {
  std::vector<std::array<int, 3>> order;  // when first seen, layer, index
  std::map<int, int> first;               // by character
  for (std::size_t i = 0; i < seen->size(); ++i) {
    const Seen& one = (*seen)[i];
    const int index = static_cast<int>(i), character = CharacterOf(one);
    const int when = character < 0 ? index : first.emplace(character, index).first->second;
    order.push_back({when, character < 0 ? 0 : FigureLayer(one.body->outlines[0].figure), index});
  }
  std::sort(order.begin(), order.end());
  std::vector<Seen> sorted;
  for (const auto& key : order) sorted.push_back((*seen)[static_cast<std::size_t>(key[2])]);
  *seen = std::move(sorted);
}

std::vector<Seen> BodiesOnPanel(const Viewport& viewport, const Playback& playback,
                                const DrawnRevision& revision, const WorldLook& look) {
  std::vector<Seen> seen;
  const Moment now = playback.MomentAt(look.peer, look.tick);
  for (const BodyShapes& body : revision.moving) {
    const std::optional<Shown> shown = playback.Find(now, body.id);
    if (!shown) continue;
    if (look.cull && !viewport.Sees(shown->pose.position, body.reach)) continue;
    seen.push_back({&body, *shown});
  }
  SortFigures(&seen);
  return seen;
}

/// A look at a few of the moments: most bodies of a large scene rest, and rest cheaply.
bool RestsOver(const Viewport& viewport, const Playback& playback, const std::vector<Moment>& past,
               PartId id) {
  const auto now = playback.Find(past.back(), id);
  for (std::size_t i = 0; now && i + 1 < past.size(); i += 9) {
    const auto then = playback.Find(past[i], id);
    if (!then) continue;
    if ((then->pose.position - now->pose.position).norm() * viewport.px_per_m > 0.5f) return false;
  }
  return true;
}

/// Where bodies came from; bodies at rest have none.
void DrawTrails(DrawList& list, const Viewport& viewport, const Playback& playback,
                const DrawnRevision& revision, const WorldLook& look) {
  std::vector<Moment> past;
  const double span = kTrailSeconds * playback.tick_hz();
  for (int i = kTrailPoints; i >= 0; --i)
    past.push_back(playback.MomentAt(look.peer, look.tick - span * i / kTrailPoints));
  for (const BodyShapes& body : revision.moving) {
    if (RestsOver(viewport, playback, past, body.id)) continue;
    std::vector<Vec2> points;
    std::vector<Colour> colours;
    float length = 0;
    bool on_panel = !look.cull;
    for (int i = 0; i <= kTrailPoints; ++i) {
      const auto shown = playback.Find(past[static_cast<std::size_t>(i)], body.id);
      if (!shown) continue;
      const Vec2 px = viewport.ToPx(shown->pose.position);
      if (!points.empty()) {
        const float step = (px - points.back()).norm();
        if (step < 0.5f) continue;  // no direction to speak of
        length += step;
      }
      on_panel = on_panel || viewport.Sees(shown->pose.position, length / viewport.px_per_m);
      points.push_back(px);
      const float age = 1 - static_cast<float>(i) / static_cast<float>(kTrailPoints);
      colours.push_back(Faded(PeerColour(shown->authority), 0.6f * (1 - age)));
    }
    if (!on_panel || length < 8 * list.font().scale()) continue;
    list.StrokeShaded(points, colours, 2 * list.font().scale());
  }
}

/// Ghosts appear where view and truth part, so that a right picture stays clean.
void DrawGhosts(DrawList& list, const Viewport& viewport, const Playback& playback,
                const DrawnRevision& revision, const WorldLook& look) {
  const Moment now = playback.MomentAt(look.peer, look.tick);
  VisitTruth(playback, revision, now, look.tick,
             [&](const BodyShapes& body, const Pose& truth, const std::optional<Pose>& shown) {
               if (look.cull && !viewport.Sees(truth.position, body.reach)) return;
               const float apart = shown ? PixelsApart(viewport, body, *shown, truth) : 1e3f;
               const float opacity =
                   std::clamp((apart / list.font().scale() - 0.75f) / 2, 0.0f, 1.0f);
               if (opacity > 0) DrawGhost(list, viewport, body, truth, 0.9f * opacity);
             });
}

void DrawImpacts(DrawList& list, const Viewport& viewport, const Playback& playback,
                 const WorldLook& look) {
  const float scale = list.font().scale();
  const double span = kImpactSeconds * playback.tick_hz();
  for (const Mark& mark : MarksBefore(playback.recording(), look.peer, look.tick, span)) {
    const auto age = static_cast<float>((look.tick - mark.tick) / span);
    const float strength = std::min(std::sqrt(mark.dv), 5.0f);
    const float radius = (3 + 3.5f * strength * (0.3f + 0.7f * age)) * scale;
    DrawSpark(list, viewport.ToPx(mark.point), radius, (3 + 1.5f * strength) * scale,
              {1.6f * scale, Faded(kSpark, 0.9f * (1 - age)), 0});
  }
}

void DrawName(DrawList& list, float left, float base, const std::string& name, int authority) {
  const float scale = list.font().scale();
  const float width = list.font().Width(TextStyle::kStrong, name);
  list.FillRect(
      {std::round(left - 4 * scale), std::round(base - 12 * scale), width + 8 * scale, 16 * scale},
      Faded(kPanel, 0.75f));
  list.Text(left + width / 2, base, TextStyle::kStrong, name, Darker(PeerColour(authority)),
            Align::kCentre);
}

/// Where a character's torso is on the panel; `otherwise` when none is seen.
float TorsoX(const Viewport& viewport, const std::vector<Seen>& seen, int character,
             float otherwise) {
  for (const Seen& one : seen) {
    const FigurePart& figure = one.body->outlines[0].figure;
    if (figure.character == character && figure.part == kTorso)
      return viewport.ToPx(one.shown.pose.position).x();
  }
  return otherwise;
}

/// The characters' names beside their heads, on the side where the rest of them is not.
void DrawCharacterNames(DrawList& list, const Viewport& viewport, const Playback& playback,
                        const std::vector<Seen>& seen) {
  const float scale = list.font().scale();
  for (const Seen& one : seen) {
    const FigurePart& figure = one.body->outlines[0].figure;
    if (figure.character < 0 || figure.part != kHead) continue;
    const auto character = static_cast<std::size_t>(figure.character);
    const Vec2 head = viewport.ToPx(one.shown.pose.position);
    const float beside = one.body->reach * viewport.px_per_m + 7 * scale;
    const std::string& name = playback.scene().characters[character].name;
    const float torso = TorsoX(viewport, seen, figure.character, head.x());
    const bool left = torso > head.x() + 0.5f * beside;
    const float from = left ? -beside - list.font().Width(TextStyle::kStrong, name) : beside;
    DrawName(list, head.x() + from, head.y() + 4 * scale, name, one.shown.authority);
  }
}

/// The players' names over their vehicles; a character has its own.
void DrawNames(DrawList& list, const Viewport& viewport, const Playback& playback,
               const std::vector<Seen>& seen) {
  const float scale = list.font().scale();
  for (const Seen& one : seen) {
    if (one.body->owner_player < 0 || CharacterOf(one) >= 0) continue;
    const auto player = static_cast<std::size_t>(one.body->owner_player);
    const std::string& name = playback.scene().players[player].name;
    float top = 1e9f;
    const Frame2 frame(one.shown.pose);
    for (const Outline& outline : one.body->outlines)
      for (const Vec2& p : outline.points)
        top = std::min(top, viewport.ToPx(frame(p)).y() - outline.radius * viewport.px_per_m);
    const float x = viewport.ToPx(one.shown.pose.position).x();
    DrawName(list, x - list.font().Width(TextStyle::kStrong, name) / 2, top - 9 * scale, name,
             one.shown.authority);
  }
  DrawCharacterNames(list, viewport, playback, seen);
}

}  // namespace

Viewport SceneViewport(const Rect& panel, const Playback& playback, int peer, double tick) {
  const auto& box = playback.scene().camera;
  Viewport viewport = Fit(panel, box.min, box.max);
  const PartId part = box.follow;
  if (part < 0) return viewport;
  const auto revision = playback.RevisionOf(playback.MomentAt(peer, tick));
  for (const BodyShapes& body : revision->moving) {
    if (std::find(body.parts.begin(), body.parts.end(), part) == body.parts.end()) continue;
    const auto truth = playback.Truth(body.id, tick);
    const auto shown = playback.Find(playback.MomentAt(peer, tick), body.id);
    if (truth) viewport.centre = truth->position;
    if (!truth && shown) viewport.centre = shown->pose.position;
  }
  return viewport;
}

void DrawWorld(DrawList& list, const Viewport& viewport, const Playback& playback,
               const WorldLook& look) {
  const Moment now = playback.MomentAt(look.peer, look.tick);
  const auto revision = playback.RevisionOf(now);
  list.Clip(viewport.panel);
  list.FillRect(viewport.panel, kPanel);
  DrawRegions(list, viewport, playback);
  DrawGrid(list, viewport);
  DrawWaters(list, viewport, playback);
  DrawGround(list, viewport, playback, *revision, look.tick, look.cull);
  DrawTriggers(list, viewport, playback, now, look.tick);
  if (look.trails) DrawTrails(list, viewport, playback, *revision, look);
  DrawRods(list, viewport, playback, now, 1);
  const std::vector<Seen> seen = BodiesOnPanel(viewport, playback, *revision, look);
  for (const Seen& one : seen)
    DrawBody(list, viewport, *one.body, one.shown.pose,
             LookOf(one.shown.authority, one.shown.role));
  DrawPins(list, viewport, playback, now, 1);
  DrawSurfaces(list, viewport, playback);
  DrawGhosts(list, viewport, playback, *revision, look);
  DrawBreaks(list, viewport, playback, now, look.tick);
  DrawImpacts(list, viewport, playback, look);
  DrawHealth(list, viewport, playback, now, look.tick);
  DrawNames(list, viewport, playback, seen);
  DrawRegionNames(list, viewport, playback);
  DrawScores(list, viewport.panel, playback, look.tick);
  DrawScaleBar(list, viewport);
  list.NoClip();
}

}  // namespace seam
