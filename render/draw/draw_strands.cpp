#include "render/draw/draw_strands.h"

#include <algorithm>
#include <map>
#include <vector>

#include "common/scene/strand.h"
#include "render/canvas/palette.h"
#include "render/playback/peer_colour.h"

namespace seam {
namespace {

using Points = std::map<int, std::vector<Vec2>>;  // by strand

Points PointsAt(const Recording& recording, int peer, std::int64_t tick) {
  Points points;
  const auto of_peer = recording.strands.find(peer);
  if (of_peer == recording.strands.end()) return points;
  const auto found = of_peer->second.find(tick);
  if (found == of_peer->second.end()) return points;
  const Strands& strands = found->second;
  for (std::size_t i = 0; i < strands.strand.size(); ++i) {
    points[strands.strand[i]].emplace_back(strands.x[i], strands.y[i]);
  }
  return points;
}

}  // namespace

void DrawStrands(DrawList& list, const Viewport& viewport, const Playback& playback,
                 const Moment& moment, int peer) {
  if (moment.before == nullptr || playback.recording().strands.empty()) return;
  const Points before = PointsAt(playback.recording(), peer, moment.before->tick);
  const Points after =
      moment.after != nullptr ? PointsAt(playback.recording(), peer, moment.after->tick) : before;
  const FeatureList<Strand>& all = playback.scene().strands;
  const float scale = list.font().scale();
  for (const auto& [index, points] : before) {
    if (index < 0 || static_cast<std::size_t>(index) >= all.size()) continue;
    const auto next = after.find(index);
    const bool both = next != after.end() && next->second.size() == points.size();
    std::vector<Vec2> px;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 to = both ? next->second[i] : points[i];
      px.push_back(viewport.ToPx(points[i] + moment.blend * (to - points[i])));
    }
    const float width =
        std::max(all[static_cast<std::size_t>(index)].width * viewport.px_per_m, 1.2f * scale);
    const auto shown = playback.Find(moment, all[static_cast<std::size_t>(index)].part);
    const Colour colour = shown ? Darker(ColourOf(playback, shown->authority)) : kInk;
    for (std::size_t i = 1; i < px.size(); ++i) {
      const float thin = static_cast<float>(i - 1) / static_cast<float>(px.size());
      list.Stroke({px[i - 1], px[i]}, false, {width * (1 - 0.8f * thin), colour, 0});
    }
  }
}

}  // namespace seam
