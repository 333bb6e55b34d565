#pragma once
/// Islands: bodies that touch each other, or belong to one mechanism.

#include <vector>

#include "common/physics/world.h"

namespace seam {

/// Returns the islands of all present bodies after the world's last tick; each is ascending.
/// Anchored bodies connect nothing.
std::vector<std::vector<int>> FindPresentIslands(const World& world);

}  // namespace seam
