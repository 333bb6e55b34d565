#pragma once
/// Reference implementation of plan.h for rectangles, without grid and sweep: the fast plan must be
/// equal to it.

#include "server/authority/plan.h"

namespace seam {

struct ReferenceEntry {
  int authority = 0;
  PeerSet secondaries;
};
using ReferencePlan = std::vector<ReferenceEntry>;

/// Computes the plan of a view with players' regions; players x boxes.
ReferencePlan PlanSlowly(const AuthorityView& view);

}  // namespace seam
