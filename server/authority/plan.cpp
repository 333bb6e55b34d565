#include "server/authority/plan.h"

#include "server/authority/plan_contested.h"
#include "server/authority/plan_followers.h"
#include "server/authority/plan_islands.h"
#include "server/authority/plan_rectangles.h"
#include "server/authority/player_of_peer.h"

namespace seam {
namespace {

/// Plans one common authority for mechanisms that are to be joined.
void BringTogether(const AuthorityView& view, AuthorityPlan* plan) {
  for (const std::vector<int>& mechanisms : view.together) {
    if (mechanisms.size() < 2) continue;
    // The peer planned for the first that has an owner; else the peer planned for the first.
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

/// Gives the server each mechanism that the planned player may not have. An untrusted player steps
/// it on, and feels no delay.
void Forbid(const AuthorityView& view, AuthorityPlan* plan) {
  const PlayerOfPeer players(view);
  for (std::size_t m = 0; m < plan->size(); ++m) {
    PlannedAuthority& planned = (*plan)[m];
    const int player = players.At(planned.authority);
    if (player < 0) continue;
    if (view.players[static_cast<std::size_t>(player)].untrusted) {
      planned.secondaries.Add(planned.authority);
      planned.authority = 0;
    } else if (!Allows(view.mechanisms[m].may_have, player)) {
      planned.authority = 0;
    }
  }
}

}  // namespace

AuthorityPlan PlanAuthority(const AuthorityView& view) {
  AuthorityPlan plan(view.mechanisms.size());
  if (!view.policy->PlansAuthority()) return plan;
  const PlanGround ground(view);
  if (view.islands) {
    PlanIslands(ground, &plan);
  } else {
    PlanRectangles(view, &plan);
  }
  if (view.policy->PlansFollowers()) {
    if (view.settles) DecideContested(ground, &plan);
    PlanFollowers(ground, &plan);
  }
  BringTogether(view, &plan);
  Forbid(view, &plan);
  return plan;
}

}  // namespace seam
