#include "server/authority/plan_rectangles.h"

#include "server/authority/dwell.h"
#include "server/authority/player_of_peer.h"

namespace seam {
namespace {

float DistanceToRegion(const Vec2& p, const PlayerView& player) {
  const Vec2 nearest = p.cwiseMax(player.region_min).cwiseMin(player.region_max);
  return (p - nearest).norm();
}

/// Returns the player of the region that the mechanism is in, present or not; -1: none.
int RegionalPlayer(const AuthorityView& view, const Vec2& at, int current_player) {
  if (current_player >= 0) {
    const PlayerView& current = view.players[static_cast<std::size_t>(current_player)];
    if (current.has_region && DistanceToRegion(at, current) <= kHysteresis) return current_player;
  }
  for (std::size_t p = 0; p < view.players.size(); ++p) {
    const PlayerView& player = view.players[p];
    if (player.has_region && DistanceToRegion(at, player) <= 0) return static_cast<int>(p);
  }
  return -1;
}

}  // namespace

void PlanRectangles(const AuthorityView& view, AuthorityPlan* plan) {
  const PlayerOfPeer players(view);
  for (std::size_t m = 0; m < plan->size(); ++m) {
    const MechanismView& mechanism = view.mechanisms[m];
    int& authority = (*plan)[m].authority;
    if (Dwells(view, players, mechanism)) {
      authority = mechanism.now.authority;
      continue;
    }
    int player = mechanism.owner;
    if (player < 0 || view.players[static_cast<std::size_t>(player)].peer < 0) {
      const int current = players.At(mechanism.now.authority);
      player = RegionalPlayer(view, mechanism.position, current);
    }
    const int peer = player >= 0 ? view.players[static_cast<std::size_t>(player)].peer : -1;
    authority = peer < 0 ? 0 : peer;
  }
}

}  // namespace seam
