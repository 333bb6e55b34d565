#pragma once
/// Who follows each mechanism in its buffer zone.

#include "server/authority/plan_ground.h"

namespace seam {

/// Adds the followers to a plan of authorities; see PlanAuthority.
void PlanFollowers(const PlanGround& ground, AuthorityPlan* plan);

}  // namespace seam
