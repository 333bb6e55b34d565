#pragma once
/// Authority by the rectangles that the scene fixes.

#include "server/authority/plan.h"

namespace seam {

/// Sets the authority of each mechanism: its owner's peer, else by regions; see PlanAuthority.
void PlanRectangles(const AuthorityView& view, AuthorityPlan* plan);

}  // namespace seam
