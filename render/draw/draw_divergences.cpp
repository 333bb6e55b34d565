#include "render/draw/draw_divergences.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "render/canvas/palette.h"

namespace seam {
namespace {

constexpr double kShownSeconds = 1;
constexpr float kRoomPx = 5;  ///< between a body and its ring

/// Rings of a panel, each with a text below where there is room.
struct Rings {
  DrawList& list;
  TextPlaces& places;
  const Viewport& viewport;
  const Playback& playback;
  const Moment now;

  void Draw(const BodyShapes& body, const std::string& text, Colour colour) const {
    const auto shown = playback.Find(now, body.id);
    if (!shown) return;
    const float scale = list.font().scale();
    const Vec2 centre = viewport.ToPx(shown->pose.position);
    const float radius = body.reach * viewport.px_per_m + kRoomPx * scale;
    list.Ring(centre, radius, {1.6f * scale, colour, 0});
    const float width = list.font().Width(TextStyle::kSmall, text) + 8 * scale;
    const auto area =
        places.Place({centre.x() - width / 2, centre.y() + radius, width, 16 * scale});
    if (!area) return;
    list.Text(area->x + width / 2, area->y + 12 * scale, TextStyle::kSmall, text, colour,
              Align::kCentre);
  }
};

struct Parted {
  float apart = 0;  // m
  bool known = false;
};

bool InLastSecond(const Recording& recording, const WorldLook& look, std::int64_t tick) {
  const auto at = static_cast<double>(tick);
  return at <= look.tick && at > look.tick - kShownSeconds * recording.room.tick_hz;
}

/// The greatest difference of each body, by id, in the last second of the peer's view.
std::map<std::int32_t, Parted> PartedBefore(const Recording& recording, const WorldLook& look) {
  std::map<std::int32_t, Parted> parted;
  for (const Divergence& d : recording.divergences) {
    for (std::size_t i = 0; d.peer == look.peer && i < d.body.size(); ++i) {
      if (!InLastSecond(recording, look, d.at[i])) continue;
      Parted& greatest = parted[d.body[i]];
      if (d.apart[i] > greatest.apart) greatest = {d.apart[i], d.missing[i] == 0};
    }
  }
  return parted;
}

}  // namespace

void DrawDivergences(DrawList& list, TextPlaces& places, const Viewport& viewport,
                     const Playback& playback, const DrawnRevision& revision,
                     const WorldLook& look) {
  const Rings rings{list, places, viewport, playback, playback.MomentAt(look.peer, look.tick)};
  const std::map<std::int32_t, Parted> parted = PartedBefore(playback.recording(), look);
  for (const BodyShapes& body : revision.moving) {
    const auto found = parted.find(body.id);
    if (found == parted.end() || found->second.apart <= 0) continue;
    rings.Draw(body, fmt::format("{:.2g} m", found->second.apart),
               Faded(kSpark, found->second.known ? 1.0f : 0.4f));
  }
}

void DrawDoubts(DrawList& list, TextPlaces& places, const Viewport& viewport,
                const Playback& playback, const DrawnRevision& revision, const WorldLook& look) {
  const Rings rings{list, places, viewport, playback, playback.MomentAt(look.peer, look.tick)};
  const Recording& recording = playback.recording();
  std::map<std::int32_t, bool> doubted;  // by id: refused
  for (const Audit& audit : recording.audits) {
    if (audit.body < 0 || !InLastSecond(recording, look, audit.tick)) continue;
    doubted[audit.body] |= audit.refused != 0;
  }
  for (const BodyShapes& body : revision.moving) {
    const auto found = doubted.find(body.id);
    if (found != doubted.end()) rings.Draw(body, found->second ? "refused" : "doubted", kSpark);
  }
}

}  // namespace seam
