#pragma once
/// Who follows each mechanism in its buffer zone, and who is near it.

#include "server/authority/plan.h"

namespace seam {

/// Adds the followers, and who is near, to a plan of authorities; see PlanAuthority.
void PlanFollowers(const AuthorityView& view, AuthorityPlan* plan);

}  // namespace seam
