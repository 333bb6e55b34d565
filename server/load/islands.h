#pragma once
/// Number of simulation islands of a world, for load reports.

#include "common/physics/world.h"

namespace seam {

/// Counts the islands of awake bodies. Bodies that touch or belong to one mechanism are of one
/// island; sleeping bodies are of none.
int CountIslands(const World& world);

}  // namespace seam
