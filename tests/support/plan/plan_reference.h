#pragma once
/// The rules of plan.h for rectangles once more, without grid and sweep: what the fast plan must be
/// equal to.

#include "server/authority/plan.h"

namespace seam {

struct ReferenceEntry {
  int authority = 0;
  PeerSet secondaries;
};
using ReferencePlan = std::vector<ReferenceEntry>;

/// Of a view whose players have regions; players x boxes.
ReferencePlan PlanSlowly(const AuthorityView& view);

}  // namespace seam
