#include "server/authority/crowds.h"

namespace seam {

Ways FindWays(const AuthorityView& view, const AuthorityPlan& plan, const PlayerOfPeer& players) {
  float longest = 0;
  for (const PlayerView& player : view.players) longest = std::max(longest, player.one_way_s);
  const float soon_s = ZoneSeconds(longest, longest), later_s = soon_s + kZoneKeep;
  Ways ways;
  ways.of.resize(plan.size());
  ways.own.resize(view.players.size());
  for (const MovingBox& box : view.boxes) {
    const Way way{WayOf(box, soon_s), WayOf(box, later_s)};
    const auto m = static_cast<std::size_t>(box.group);
    ways.of[m].Raise(way);
    ways.farthest.Raise(way);
    const int player = plan[m].authority > 0 ? players.At(plan[m].authority) : -1;
    if (player >= 0) ways.own[static_cast<std::size_t>(player)].Raise(way);
  }
  return ways;
}

}  // namespace seam
