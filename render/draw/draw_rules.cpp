#include "render/draw/draw_rules.h"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>

#include "common/scene/part_rules.h"
#include "render/canvas/palette.h"
#include "render/playback/format.h"

namespace seam {
namespace {

/// Values of metadata at a tick, by kind, id and key.
using Known = std::map<std::tuple<int, int, int>, float>;

Known KnownAt(const Recording& recording, double tick) {
  Known known;
  for (const Meta& meta : recording.meta) {
    if (static_cast<double>(meta.tick) > tick) continue;
    for (std::size_t i = 0; i < meta.value.size(); ++i)
      known[{meta.kind[i], meta.id[i], meta.key[i]}] = meta.value[i];
  }
  return known;
}

float Get(const Known& known, int kind, int id, int key, float otherwise) {
  const auto found = known.find({kind, id, key});
  return found == known.end() ? otherwise : found->second;
}

Colour ColourOf(TriggerKind kind) {
  switch (kind) {
    case TriggerKind::kHazard: return kSpark;
    case TriggerKind::kPickup: return {0, 128, 92, 255};
    case TriggerKind::kCheckpoint: return {90, 70, 160, 255};
    case TriggerKind::kArea: break;
  }
  return kFaintInk;
}

std::string LabelOf(const Trigger& trigger) {
  if (trigger.kind == TriggerKind::kCheckpoint)
    return "checkpoint " + std::to_string(trigger.order);
  return trigger.name;
}

}  // namespace

void DrawTriggers(DrawList& list, TextPlaces& places, const Viewport& viewport,
                  const Playback& playback, const Moment& moment, double tick) {
  const auto& triggers = playback.scene().triggers;
  if (triggers.empty()) return;
  const Known known = KnownAt(playback.recording(), tick);
  const float scale = list.font().scale();
  for (const Trigger& trigger : triggers) {
    Vec2 centre = trigger.position;
    if (trigger.part >= 0) {
      if (Get(known, kMetaPart, trigger.part, kMetaTaken, 0) > 0) continue;
      const auto part = playback.FindPart(moment, trigger.part);
      if (!part) continue;
      centre += part->position;
    }
    if (!viewport.Sees(centre, trigger.size.norm() / 2)) continue;
    const Vec2 corner = viewport.ToPx(centre + Vec2(-trigger.size.x(), trigger.size.y()) / 2);
    const Vec2 size = trigger.size * viewport.px_per_m;
    const Colour colour = ColourOf(trigger.kind);
    const Rect box{corner.x(), corner.y(), size.x(), size.y()};
    list.FillRect(box, Faded(colour, 0.07f));
    list.StrokeRect(box, {1.2f * scale, Faded(colour, 0.8f), 6 * scale});
    const std::string label = LabelOf(trigger);
    const float width = list.font().Width(TextStyle::kSmall, label);
    if (label.empty() || width >= box.width + 30 * scale) continue;
    const auto area =
        places.Place({box.x + (box.width - width) / 2, box.y - 15 * scale, width, 15 * scale});
    if (!area) continue;
    list.Text(area->x, area->y + 12 * scale, TextStyle::kSmall, label, colour);
  }
}

void DrawHealth(DrawList& list, const Viewport& viewport, const Playback& playback,
                const Moment& moment, double tick) {
  const auto world = playback.WorldOf(moment);
  const float scale = list.font().scale();
  Known known;
  bool looked = false;
  for (const Part& part : world->scene().parts) {
    if (part.rules->health <= 0 || part.gone) continue;
    if (!looked) known = KnownAt(playback.recording(), tick);
    looked = true;
    const auto pose = playback.FindPart(moment, part.id);
    if (!pose || !viewport.Sees(pose->position, 1)) continue;
    const float left = Get(known, kMetaPart, part.id, kMetaHealth, part.rules->health);
    const float share = std::clamp(left / part.rules->health, 0.0f, 1.0f);
    const Vec2 px = viewport.ToPx(pose->position);
    const float width = 24 * scale, height = 4 * scale;
    const Rect all{px.x() - width / 2, px.y() - 12 * scale, width, height};
    list.FillRect(all, Faded(kPanel, 0.85f));
    list.FillRect({all.x, all.y, width * share, height}, Mix(kSpark, {0, 128, 92, 255}, share));
    list.StrokeRect(all, {0.8f * scale, kFaintInk, 0});
  }
}

ScoreLine ScoresAt(const DrawList& list, const Rect& panel, const Playback& playback, double tick) {
  if (playback.recording().meta.empty()) return {};
  const Known known = KnownAt(playback.recording(), tick);
  const float scale = list.font().scale();
  const auto& players = playback.scene().players;
  std::string text;
  for (std::size_t p = 0; p < players.size(); ++p) {
    const auto get = [&](int key) { return Get(known, kMetaPlayer, static_cast<int>(p), key, 0); };
    std::string own;
    if (get(kMetaScore) != 0) own += " " + FormatNumber(static_cast<double>(get(kMetaScore)), 0);
    if (get(kMetaLaps) > 0) own += " lap " + FormatNumber(static_cast<double>(get(kMetaLaps)), 0);
    if (get(kMetaCheckpoint) > 0)
      own += " at " + FormatNumber(static_cast<double>(get(kMetaCheckpoint)), 0);
    if (!own.empty()) text += (text.empty() ? "" : "   ") + players[p].name + own;
  }
  if (text.empty()) return {};
  const float width = list.font().Width(TextStyle::kStrong, text) + 10 * scale;
  return {text, {panel.x + 5 * scale, panel.y + 23 * scale, width, 18 * scale}};
}

void DrawScores(DrawList& list, const ScoreLine& scores) {
  const float scale = list.font().scale();
  if (scores.text.empty()) return;
  list.FillRect(scores.area, Faded(kPanel, 0.8f));
  list.Text(scores.area.x + 5 * scale, scores.area.y + 13 * scale, TextStyle::kStrong, scores.text,
            kInk);
}

}  // namespace seam
