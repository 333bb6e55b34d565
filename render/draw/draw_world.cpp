#include "render/draw/draw_world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "common/base/geometry.h"
#include "common/scene/character.h"
#include "render/canvas/figure.h"
#include "render/canvas/palette.h"
#include "render/draw/draw_blasts.h"
#include "render/draw/draw_body.h"
#include "render/draw/draw_divergences.h"
#include "render/draw/draw_ghosts.h"
#include "render/draw/draw_joints.h"
#include "render/draw/draw_rules.h"
#include "render/draw/draw_scene.h"
#include "render/draw/draw_strands.h"
#include "render/draw/text_places.h"
#include "render/playback/camera.h"
#include "render/playback/marks.h"
#include "render/playback/peer_colour.h"

namespace seam {
namespace {

constexpr double kTrailSeconds = 1.2;
constexpr float kDotRadius = 1.3f;      ///< px at scale 1
constexpr int kFewGhosts = 20;          ///< more ghosts are drawn fainter
constexpr double kImpactSeconds = 0.5;  ///< how long a mark stays

struct Seen {
  const BodyShapes* body = nullptr;
  Shown shown;
};

/// Returns the character of a body, or -1.
int CharacterOf(const Seen& one) { return one.body->outlines[0].figure.character; }

/// Groups each character's bodies, far limbs first; the order of other bodies stays.
void SortFigures(std::vector<Seen>* seen) {
  std::vector<std::array<int, 3>> order;  // position of the group, layer, index
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

/// Draws earlier displayed positions, one dot for each tick: even dots are an even motion, a gap is
/// a jump and a cluster a stop.
void DrawTrails(DrawList& list, const Viewport& viewport, const Playback& playback,
                const DrawnRevision& revision, const WorldLook& look) {
  const float scale = list.font().scale();
  const double last = std::floor(look.tick), first = last - kTrailSeconds * playback.tick_hz();
  std::vector<Moment> past;
  for (double tick = std::ceil(first); tick <= last; ++tick)
    past.push_back(playback.MomentAt(look.peer, tick));
  for (const BodyShapes& body : revision.moving) {
    if (!body.leads && !look.parts) continue;
    Vec2 before(1e9f, 1e9f);
    for (const Moment& moment : past) {
      if (moment.before == nullptr || moment.blend != 0) continue;  // a tick without a view
      const auto shown = playback.Find(moment, body.id);
      if (!shown || (look.cull && !viewport.Sees(shown->pose.position, 0.1f))) continue;
      const Vec2 px = viewport.ToPx(shown->pose.position);
      if ((px - before).norm() < 0.4f) continue;  // it rests: one dot is enough
      before = px;
      const auto age = static_cast<float>((look.tick - moment.tick) / (last - first + 1));
      list.Disc(px, kDotRadius * scale,
                Faded(Darker(ColourOf(playback, shown->authority)), 0.9f - 0.8f * age));
    }
  }
}

/// Returns the distance of the body's drawn poses in view and oracle, px at scale 1; 1000 where it
/// is not shown.
float ApartPx(const DrawList& list, const Viewport& viewport, const BodyShapes& body,
              const Pose& truth, const std::optional<Pose>& shown) {
  return shown ? PixelsApart(viewport, body, *shown, truth) / list.font().scale() : 1e3f;
}

/// Draws ghosts where view and oracle differ, so that a correct picture stays clean. Many ghosts,
/// as in a pile, are fainter.
void DrawGhosts(DrawList& list, const Viewport& viewport, const Playback& playback,
                const DrawnRevision& revision, const WorldLook& look) {
  const Moment now = playback.MomentAt(look.peer, look.tick);
  int apart = 0;
  const auto visit = [&](const auto& draw) {
    VisitTruth(playback, revision, now,
               [&](const BodyShapes& body, const Pose& truth, const std::optional<Pose>& shown) {
                 if (look.cull && !viewport.Sees(truth.position, body.reach)) return;
                 const float px = ApartPx(list, viewport, body, truth, shown);
                 if (px > 0.75f) draw(body, truth, std::min((px - 0.75f) / 2, 1.0f));
               });
  };
  visit([&](const BodyShapes&, const Pose&, float) { ++apart; });
  const float onion =
      apart <= kFewGhosts ? 1 : std::max(0.3f, kFewGhosts / static_cast<float>(apart));
  visit([&](const BodyShapes& body, const Pose& truth, float opacity) {
    DrawGhost(list, viewport, body, truth, 0.9f * opacity * onion);
  });
}

/// Draws arrows from the oracle's position of a body to the displayed one.
void DrawVectors(DrawList& list, const Viewport& viewport, const Playback& playback,
                 const DrawnRevision& revision, const WorldLook& look) {
  const float scale = list.font().scale();
  const Moment now = playback.MomentAt(look.peer, look.tick);
  VisitTruth(playback, revision, now,
             [&](const BodyShapes& body, const Pose& truth, const std::optional<Pose>& shown) {
               if (!shown || !viewport.Sees(truth.position, body.reach)) return;
               const Vec2 from = viewport.ToPx(truth.position), to = viewport.ToPx(shown->position);
               const float length = (to - from).norm();
               if (length < 2 * scale) return;
               const Vec2 way = (to - from) / length, side(-way.y(), way.x());
               const float head = std::min(6 * scale, length / 2);
               const Line line{1.6f * scale, kSpark, 0};
               list.Stroke({from, to}, false, line);
               list.Stroke({to - head * (way + 0.5f * side), to, to - head * (way - 0.5f * side)},
                           false, line);
             });
}

/// Returns the distance of a body's displayed position from the oracle's, m; 0 if unknown.
float ErrorOf(const Playback& playback, const Moment& now, const BodyShapes& body) {
  const auto shown = playback.Find(now, body.id);
  const auto truth = shown ? playback.Truth(body.id, shown->tick) : std::nullopt;
  if (!truth) return 0;
  const float turn = body.round ? 0 : std::abs(WrapAngle(shown->pose.angle - truth->angle));
  return (shown->pose.position - truth->position).norm() + turn * body.reach;
}

BodyLook LookWith(const Playback& playback, const Moment& now, const Seen& one,
                  const WorldLook& look) {
  BodyLook body = LookOf(ColourOf(playback, one.shown.authority), one.shown.role);
  if (look.pale) {
    body.fill = Mix(body.fill, kPanel, 0.7f);
    body.edge = Mix(body.edge, kPanel, 0.5f);
  }
  if (look.heat) {
    body.fill = HeatColour(ErrorOf(playback, now, *one.body));
    body.hatched = false;
  }
  return body;
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

/// Draws a name with its middle at (middle, base) or the nearest free place; not at all where no
/// place is free.
void DrawName(DrawList& list, TextPlaces& places, const Vec2& at, TextStyle style,
              const std::string& name, Colour colour) {
  const float scale = list.font().scale();
  const float width = list.font().Width(style, name) + 8 * scale;
  const auto area = places.Place(
      {std::round(at.x() - width / 2), std::round(at.y() - 12 * scale), width, 16 * scale});
  if (!area) return;
  list.FillRect(*area, Faded(kPanel, 0.75f));
  list.Text(area->x + width / 2, area->y + 12 * scale, style, name, Darker(colour), Align::kCentre);
}

/// Returns a name, with the peer's number where colours repeat.
std::string Named(const std::string& name, int peer) {
  return peer > kPeerHues ? name + " (" + std::to_string(peer) + ")" : name;
}

/// Returns the x of a character's torso on the panel; `otherwise` when it is not seen.
float TorsoX(const Viewport& viewport, const std::vector<Seen>& seen, int character,
             float otherwise) {
  for (const Seen& one : seen) {
    const FigurePart& figure = one.body->outlines[0].figure;
    if (figure.character == character && figure.part == kTorso)
      return viewport.ToPx(one.shown.pose.position).x();
  }
  return otherwise;
}

/// Draws the characters' names beside their heads, on the side away from the torso.
void DrawCharacterNames(DrawList& list, TextPlaces& places, const Viewport& viewport,
                        const Playback& playback, const std::vector<Seen>& seen) {
  const float scale = list.font().scale();
  for (const Seen& one : seen) {
    const FigurePart& figure = one.body->outlines[0].figure;
    if (figure.character < 0 || figure.part != kHead) continue;
    const auto character = static_cast<std::size_t>(figure.character);
    const Vec2 head = viewport.ToPx(one.shown.pose.position);
    const float beside = one.body->reach * viewport.px_per_m + 7 * scale;
    const std::string name =
        Named(playback.scene().characters[character].name, one.shown.authority);
    const float torso = TorsoX(viewport, seen, figure.character, head.x());
    const bool left = torso > head.x() + 0.5f * beside;
    const float away = beside + list.font().Width(TextStyle::kStrong, name) / 2;
    DrawName(list, places, {head.x() + (left ? -away : away), head.y() + 4 * scale},
             TextStyle::kStrong, name, ColourOf(playback, one.shown.authority));
  }
}

bool IsVehicle(const Seen& one) { return one.body->owner_player >= 0 && CharacterOf(one) < 0; }

/// Draws the names of the players' vehicles, or of all other bodies, over them.
void DrawBodyNames(DrawList& list, TextPlaces& places, const Viewport& viewport,
                   const Playback& playback, const std::vector<Seen>& seen, bool vehicles) {
  const float scale = list.font().scale();
  for (const Seen& one : seen) {
    if (IsVehicle(one) != vehicles) continue;
    const std::string& name =
        vehicles ? playback.scene().players[static_cast<std::size_t>(one.body->owner_player)].name
                 : playback.PartName(one.body->id);
    float top = 1e9f;
    const Frame2 frame(one.shown.pose);
    for (const Outline& outline : one.body->outlines)
      for (const Vec2& p : outline.points)
        top = std::min(top, viewport.ToPx(frame(p)).y() - outline.radius * viewport.px_per_m);
    const float x = viewport.ToPx(one.shown.pose.position).x();
    const float y = std::max(top - (vehicles ? 9 : 4) * scale, viewport.panel.y + 14 * scale);
    DrawName(list, places, {x, y}, vehicles ? TextStyle::kStrong : TextStyle::kSmall,
             Named(name, one.shown.authority), ColourOf(playback, one.shown.authority));
  }
}

/// Draws the names of vehicles and characters, and then, with `all`, those of all other bodies.
void DrawNames(DrawList& list, TextPlaces& places, const Viewport& viewport,
               const Playback& playback, const std::vector<Seen>& seen, bool all) {
  DrawBodyNames(list, places, viewport, playback, seen, true);
  DrawCharacterNames(list, places, viewport, playback, seen);
  if (all) DrawBodyNames(list, places, viewport, playback, seen, false);
}

}  // namespace

Viewport SceneViewport(const Rect& panel, const Playback& playback, int peer, double tick) {
  const PartId part = playback.scene().camera.follow;
  constexpr double kLookBack_s = 2;  // a growing recording is looked through for each frame
  const double now_s = tick / playback.tick_hz();
  const double from_s = std::min(now_s, std::max(playback.first_s(), now_s - kLookBack_s));
  const WorldBox box = ActionArea({{&playback, peer}}, from_s, now_s);
  Viewport viewport = Fit(panel, box.min, box.max);
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
  TextPlaces places(viewport.panel, look.texts);
  places.Take(ScaleBarArea(list, viewport));
  list.Clip(viewport.panel);
  DrawRegions(list, viewport, playback, now);
  DrawWaters(list, viewport, playback);
  DrawGround(list, viewport, playback, *revision, look.tick, look.cull);
  const ScoreLine scores = ScoresAt(list, viewport.panel, playback, look.tick);
  places.Take(scores.area);
  DrawTriggers(list, places, viewport, playback, now, look.tick);
  DrawCharges(list, viewport, playback, now, look.tick);
  if (look.trails) DrawTrails(list, viewport, playback, *revision, look);
  DrawRods(list, viewport, playback, now, 1);
  const std::vector<Seen> seen = BodiesOnPanel(viewport, playback, *revision, look);
  for (const Seen& one : seen)
    DrawBody(list, viewport, *one.body, one.shown.pose, LookWith(playback, now, one, look));
  DrawStrands(list, viewport, playback, now, look.peer);
  DrawPins(list, viewport, playback, now, 1);
  DrawSurfaces(list, viewport, playback);
  if (look.ghosts) DrawGhosts(list, viewport, playback, *revision, look);
  if (look.vectors) DrawVectors(list, viewport, playback, *revision, look);
  if (look.divergence) DrawDivergences(list, places, viewport, playback, *revision, look);
  if (look.doubts) DrawDoubts(list, places, viewport, playback, *revision, look);
  DrawBreaks(list, viewport, playback, now, look.tick);
  DrawBlasts(list, viewport, playback, now, look.tick);
  DrawImpacts(list, viewport, playback, look);
  DrawHealth(list, viewport, playback, now, look.tick);
  if (!look.pale) DrawNames(list, places, viewport, playback, seen, look.names);
  DrawScores(list, scores);
  DrawScaleBar(list, viewport);
  list.NoClip();
}

}  // namespace seam
