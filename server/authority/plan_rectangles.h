#pragma once
/// Authority by the fixed rectangles of the scene.

#include "server/authority/plan.h"

namespace seam {

/// Sets the authority of each mechanism: the owner's peer, else by region; see PlanAuthority.
void PlanRectangles(const AuthorityView& view, AuthorityPlan* plan);

}  // namespace seam
