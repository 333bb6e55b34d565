#pragma once
/// How many groups of bodies that influence each other a world has: for those who watch its cost.

#include "common/physics/world.h"

namespace seam {

/// Awake bodies that touch, or belong to one mechanism, are of one island; so is all that is
/// connected in this way. A sleeping body is of none.
int CountIslands(const World& world);

}  // namespace seam
