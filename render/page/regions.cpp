#include "common/scene/planner/planner_rules.h"
#include "render/page/worlds.h"

namespace seam {
namespace {

std::vector<Vec2> Corners(const Vec2& min, const Vec2& max) {
  return {min, {max.x(), min.y()}, max, {min.x(), max.y()}};
}

}  // namespace

std::vector<PageRegion> RegionsOfPage(const Playback& playback) {
  std::vector<PageRegion> regions;
  if (!playback.policy().PlansAuthority()) return regions;
  if (playback.scene().planner->given) return regions;  // regions do not decide
  for (const int peer : playback.peers()) {
    const int index = playback.PlayerOf(peer);
    if (index < 0) continue;
    const Player& player = playback.scene().players[static_cast<std::size_t>(index)];
    if (!player.has_region) continue;
    regions.push_back({peer, false, player.name, Corners(player.region_min, player.region_max)});
    if (!playback.policy().PlansFollowers()) continue;
    const Vec2 band(playback.scene().buffer_m, playback.scene().buffer_m);
    regions.push_back(
        {peer, true, player.name, Corners(player.region_min - band, player.region_max + band)});
  }
  return regions;
}

}  // namespace seam
