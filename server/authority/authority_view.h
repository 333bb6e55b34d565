#pragma once
/// Facts of a scene that the planner needs, computed once instead of at every plan.

#include <vector>

#include "common/scene/scene.h"

namespace seam {

/// True if authority is planned by islands around the players: the scene has [planner], or its
/// players have no regions.
bool PlansIslands(const Scene& scene);

/// Returns the parts that not every player may push, ascending.
std::vector<int> RestrictedParts(const Scene& scene);

}  // namespace seam
