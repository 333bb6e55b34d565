#pragma once
/// Which mechanisms may come into contact before a grant could tell anyone, and through whom.

#include <vector>

#include "server/authority/plan_ground.h"

namespace seam {

/// By mechanism. `soon` looks as far ahead as ZoneSeconds says, `later` kZoneKeep farther.
struct ContactGroups {
  std::vector<int> soon, later;  ///< the lowest of those that it may touch, directly or not
  /// 1: it may touch one that the server has, or has one and may touch.
  std::vector<char> server_soon, server_later;
};

/// Of mechanisms with the planned authorities. May touch: as MayMeet says. `by_ways`: what falls
/// freely, but for what is the server's, as MayMeetOnTheirWays says, too, if gravity has an axis.
ContactGroups FindContactGroups(const PlanGround& ground, const AuthorityPlan& plan, bool by_ways);

}  // namespace seam
