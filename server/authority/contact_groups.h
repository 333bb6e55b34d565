#pragma once
/// Groups of mechanisms that may come into contact before a grant could reach the peers.

#include <vector>

#include "server/authority/plan_ground.h"

namespace seam {

/// By mechanism. `soon` looks ZoneSeconds ahead, `later` kZoneKeep farther.
struct ContactGroups {
  std::vector<int> soon, later;  ///< lowest index in its group of direct and indirect contacts
  /// 1: it may touch one of the server's, or is one and may touch another.
  std::vector<char> server_soon, server_later;
};

/// Groups mechanisms with their planned authorities by MayMeet. With `by_path`, and if gravity has
/// an axis, a freely falling mechanism must also pass MayMeetInFall; pairs with the server's
/// mechanisms need not.
ContactGroups FindContactGroups(const PlanGround& ground, const AuthorityPlan& plan, bool by_path);

}  // namespace seam
