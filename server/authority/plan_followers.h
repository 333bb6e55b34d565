#pragma once
/// Followers of each mechanism: the buffer zones.

#include "server/authority/plan_ground.h"

namespace seam {

/// Adds followers to a plan of authorities; see PlanAuthority.
void PlanFollowers(const PlanGround& ground, AuthorityPlan* plan);

}  // namespace seam
