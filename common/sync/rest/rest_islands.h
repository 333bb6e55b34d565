#pragma once
/// Islands: bodies that touch each other, or belong to one mechanism.

#include <vector>

#include "common/physics/world.h"

namespace seam {

/// The islands of bodies that are present, after the world's last tick; each ascending. Anchored
/// bodies join nothing.
std::vector<std::vector<int>> FindPresentIslands(const World& world);

}  // namespace seam
