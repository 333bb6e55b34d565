#include "server/authority/plan_capacity.h"

#include <algorithm>
#include <cfloat>

namespace seam {
namespace {

/// Part of an island without a driver, planned for one player.
struct Share {
  int player = -1;
  float gap = FLT_MAX;  // m from the island to the player's vehicles
  int island = 0;
  int bodies = 0;
  bool held = false;  // the player has some of it already
};

bool Limited(const AuthorityView& view, int player) {
  return view.players[static_cast<std::size_t>(player)].capacity != PlayerView::kUnlimited;
}

/// Returns the distance from an island to the vehicles of the player it is planned for, m.
float GapTo(int player, const Island& island) {
  if (island.driver == player) return 0;
  if (island.holder == player) return island.holder_gap;
  return island.nearest == player || island.claim == player ? island.nearest_gap : FLT_MAX;
}

}  // namespace

void LimitToCapacity(const AuthorityView& view, const PlayerOfPeer& players, const Islands& islands,
                     AuthorityPlan* plan) {
  const bool any = std::any_of(view.players.begin(), view.players.end(),
                               [](const PlayerView& p) { return p.limited(); });
  if (!any) return;
  std::vector<int> steps(view.players.size(), 0);
  std::vector<Share> shares;
  for (std::size_t i = 0; i < islands.all().size(); ++i) {
    const auto first = shares.size();
    for (const int m : islands.MembersOf(static_cast<int>(i))) {
      const int player = players.At((*plan)[static_cast<std::size_t>(m)].authority);
      if (player < 0 || !Limited(view, player)) continue;
      if (islands.driver(m) == player) {
        steps[static_cast<std::size_t>(player)] += islands.bodies(m);
        continue;
      }
      auto share = std::find_if(shares.begin() + static_cast<std::ptrdiff_t>(first), shares.end(),
                                [&](const Share& s) { return s.player == player; });
      if (share == shares.end()) {
        shares.push_back({player, GapTo(player, islands.all()[i]), static_cast<int>(i), 0, false});
        share = shares.end() - 1;
      }
      share->bodies += islands.bodies(m);
      const AuthorityRecord& now = view.mechanisms[static_cast<std::size_t>(m)].now;
      share->held = share->held || players.At(now.authority) == player;
    }
  }
  std::sort(shares.begin(), shares.end(), [](const Share& a, const Share& b) {
    return a.gap != b.gap ? a.gap < b.gap : a.island < b.island;
  });
  for (const Share& share : shares) {
    int& has = steps[static_cast<std::size_t>(share.player)];
    const auto capacity =
        static_cast<float>(view.players[static_cast<std::size_t>(share.player)].capacity);
    if (static_cast<float>(has + share.bodies) <= capacity * (share.held ? kShed : kAdmit)) {
      has += share.bodies;
      continue;
    }
    for (const int m : islands.MembersOf(share.island)) {
      int& authority = (*plan)[static_cast<std::size_t>(m)].authority;
      const bool its = players.At(authority) == share.player && islands.driver(m) != share.player;
      if (its) authority = 0;
    }
  }
}

}  // namespace seam
