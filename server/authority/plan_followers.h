#pragma once
/// Who follows each mechanism in its buffer zone.

#include "server/authority/plan.h"

namespace seam {

/// Adds the followers to a plan of authorities; see PlanAuthority.
void PlanFollowers(const AuthorityView& view, AuthorityPlan* plan);

}  // namespace seam
