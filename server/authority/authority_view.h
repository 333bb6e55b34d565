#pragma once
/// What planning needs to know of a scene once, and not at every plan.

#include <vector>

#include "common/scene/scene.h"

namespace seam {

/// Whether authority is planned by islands around the players: the scene says [planner], or its
/// players have no regions.
bool PlansIslands(const Scene& scene);

/// Parts that not every player may push, ascending.
std::vector<int> RestrictedParts(const Scene& scene);

}  // namespace seam
