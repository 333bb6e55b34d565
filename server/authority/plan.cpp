#include "server/authority/plan.h"

namespace seam {
namespace {

float DistanceToBox(const Vec2& p, const Vec2& min, const Vec2& max) {
  const Vec2 nearest = p.cwiseMax(min).cwiseMin(max);
  return (p - nearest).norm();
}

float DistanceToRegion(const Vec2& p, const PlayerView& player) {
  return DistanceToBox(p, player.region_min, player.region_max);
}

/// The player whose peer has the mechanism; -1: the server, or a peer that plays nobody.
int CurrentPlayer(const AuthorityView& view, const MechanismView& mechanism) {
  int current = -1;
  for (std::size_t p = 0; p < view.players.size(); ++p) {
    const bool has = mechanism.now.authority > 0 && view.players[p].peer == mechanism.now.authority;
    if (has) current = static_cast<int>(p);
  }
  return current;
}

/// The player in whose region the mechanism is, present or not; -1: none.
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

int PlannedHolder(const AuthorityView& view, const MechanismView& mechanism) {
  const int current_player = CurrentPlayer(view, mechanism);
  const auto dwell_ticks = static_cast<std::int64_t>(kDwell * view.tick_hz);
  if (current_player >= 0 && mechanism.held_ticks < dwell_ticks) return mechanism.now.authority;
  int player = mechanism.owner;
  if (player < 0 || view.players[static_cast<std::size_t>(player)].peer < 0) {
    player = RegionalPlayer(view, mechanism.position, current_player);
  }
  const int peer = player >= 0 ? view.players[static_cast<std::size_t>(player)].peer : -1;
  return peer < 0 ? 0 : peer;
}

/// Adds to each mechanism the peers in whose buffer zone it is.
void AddFollowers(const AuthorityView& view, AuthorityPlan* plan) {
  const std::size_t count = plan->size();
  for (const PlayerView& player : view.players) {
    if (player.peer <= 0) continue;
    for (std::size_t m = 0; m < count; ++m) {
      PlannedAuthority& planned = (*plan)[m];
      if (planned.authority == player.peer) continue;
      const MechanismView& mechanism = view.mechanisms[m];
      const bool follows = mechanism.now.secondaries.Has(player.peer);
      const float reach = view.buffer_m + (follows ? kHysteresis : 0.0f);
      bool near = player.has_region && DistanceToRegion(mechanism.position, player) <= reach;
      for (std::size_t o = 0; o < count && !near; ++o) {
        near = (*plan)[o].authority == player.peer &&
               (view.mechanisms[o].position - mechanism.position).norm() <= reach;
      }
      if (near) planned.secondaries.Add(player.peer);
    }
  }
}

/// Plans mechanisms that are to be joined for the same authority.
void BringTogether(const AuthorityView& view, AuthorityPlan* plan) {
  for (const std::vector<int>& mechanisms : view.together) {
    if (mechanisms.size() < 2) continue;
    // To whom the owner of either plays; else to whom has the first.
    int to = (*plan)[static_cast<std::size_t>(mechanisms.front())].authority;
    for (const int m : mechanisms) {
      if (view.mechanisms[static_cast<std::size_t>(m)].owner >= 0) {
        to = (*plan)[static_cast<std::size_t>(m)].authority;
        break;
      }
    }
    for (const int m : mechanisms) {
      PlannedAuthority& planned = (*plan)[static_cast<std::size_t>(m)];
      if (planned.authority != to) planned.secondaries.Add(planned.authority);
      planned.authority = to;
      planned.secondaries.Remove(to);
    }
  }
}

/// What a player may not have is the server's.
void Forbid(const AuthorityView& view, AuthorityPlan* plan) {
  for (std::size_t m = 0; m < plan->size(); ++m) {
    PlannedAuthority& planned = (*plan)[m];
    for (std::size_t p = 0; p < view.players.size() && planned.authority > 0; ++p) {
      const bool allowed = Allows(view.mechanisms[m].may_have, static_cast<int>(p));
      if (view.players[p].peer == planned.authority && !allowed) planned.authority = 0;
    }
  }
}

}  // namespace

AuthorityPlan PlanAuthority(const AuthorityView& view) {
  AuthorityPlan plan(view.mechanisms.size());
  if (view.mode == Mode::kOracle || view.mode == Mode::kCentral) return plan;
  for (std::size_t m = 0; m < plan.size(); ++m) {
    plan[m].authority = PlannedHolder(view, view.mechanisms[m]);
  }
  if (view.mode == Mode::kBuffer) AddFollowers(view, &plan);
  BringTogether(view, &plan);
  Forbid(view, &plan);
  return plan;
}

}  // namespace seam
