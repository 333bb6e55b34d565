#include "render/draw/draw_divergences.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "render/canvas/palette.h"

namespace seam {
namespace {

constexpr double kShownSeconds = 1;
constexpr float kRoomPx = 5;  ///< between a body and its ring

struct Parted {
  float apart = 0;  // m
  bool known = false;
};

/// The greatest difference of each body, by id, in the last second of the peer's view.
std::map<std::int32_t, Parted> PartedBefore(const Recording& recording, const WorldLook& look) {
  const double from = look.tick - kShownSeconds * recording.room.tick_hz;
  std::map<std::int32_t, Parted> parted;
  for (const Divergence& d : recording.divergences) {
    for (std::size_t i = 0; d.peer == look.peer && i < d.body.size(); ++i) {
      const auto at = static_cast<double>(d.at[i]);
      Parted& greatest = parted[d.body[i]];
      if (at <= from || at > look.tick || d.apart[i] <= greatest.apart) continue;
      greatest = {d.apart[i], d.missing[i] == 0};
    }
  }
  return parted;
}

}  // namespace

void DrawDivergences(DrawList& list, TextPlaces& places, const Viewport& viewport,
                     const Playback& playback, const DrawnRevision& revision,
                     const WorldLook& look) {
  const float scale = list.font().scale();
  const std::map<std::int32_t, Parted> parted = PartedBefore(playback.recording(), look);
  const Moment now = playback.MomentAt(look.peer, look.tick);
  for (const BodyShapes& body : revision.moving) {
    const auto found = parted.find(body.id);
    const auto shown = playback.Find(now, body.id);
    if (found == parted.end() || found->second.apart <= 0 || !shown) continue;
    const Colour colour = Faded(kSpark, found->second.known ? 1.0f : 0.4f);
    const Vec2 centre = viewport.ToPx(shown->pose.position);
    const float radius = body.reach * viewport.px_per_m + kRoomPx * scale;
    list.Ring(centre, radius, {1.6f * scale, colour, 0});
    const std::string text = fmt::format("{:.2g} m", found->second.apart);
    const float width = list.font().Width(TextStyle::kSmall, text) + 8 * scale;
    const auto area =
        places.Place({centre.x() - width / 2, centre.y() + radius, width, 16 * scale});
    if (!area) continue;
    list.Text(area->x + width / 2, area->y + 12 * scale, TextStyle::kSmall, text, colour,
              Align::kCentre);
  }
}

}  // namespace seam
