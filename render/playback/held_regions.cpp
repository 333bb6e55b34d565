#include "render/playback/held_regions.h"

#include <algorithm>

#include "common/scene/planner/planner_rules.h"

namespace seam {

bool RegionsAreHeld(const Playback& playback) {
  if (!playback.policy().PlansAuthority()) return false;
  const std::vector<Player>& players = playback.scene().players;
  const bool fixed = std::any_of(players.begin(), players.end(),
                                 [](const Player& player) { return player.has_region; });
  return !fixed || playback.scene().planner->given;
}

std::vector<HeldRegion> HeldRegions(const Playback& playback, const Moment& moment) {
  if (moment.before == nullptr || !RegionsAreHeld(playback)) return {};
  std::map<int, HeldRegion> by_peer;
  const std::shared_ptr<const DrawnRevision> drawn = playback.RevisionOf(moment);
  for (const BodyShapes& body : drawn->moving) {
    const std::optional<Shown> shown = playback.Find(moment, body.id);
    if (!shown || shown->authority <= 0) continue;
    const Vec2 reach = Vec2(1, 1) * (body.reach + kHeldMargin);
    const Vec2 low = shown->pose.position - reach, high = shown->pose.position + reach;
    const auto [at, first] = by_peer.try_emplace(shown->authority);
    HeldRegion& region = at->second;
    region.peer = shown->authority;
    region.min = first ? low : region.min.cwiseMin(low);
    region.max = first ? high : region.max.cwiseMax(high);
  }
  std::vector<HeldRegion> all;
  for (const auto& [peer, region] : by_peer) all.push_back(region);
  return all;
}

}  // namespace seam
