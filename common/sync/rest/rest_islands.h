#pragma once
/// Islands: bodies that touch each other, or belong to one mechanism.

#include <vector>

#include "common/physics/world.h"

namespace seam {

/// The islands after the world's last tick; each ascending. Anchored bodies join nothing.
std::vector<std::vector<int>> FindIslands(const World& world);
/// The same of bodies that are not absent.
std::vector<std::vector<int>> FindPresentIslands(const World& world);

}  // namespace seam
