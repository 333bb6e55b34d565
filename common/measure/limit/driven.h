#pragma once
/// Bodies that a player drives, and therefore sees without network delay.

#include <vector>

#include "common/physics/world.h"

namespace seam {

/// Returns, by body, true if a part makes its mechanism the player's own (EachOwnPart).
std::vector<bool> DrivenBy(const World& world, int player);

}  // namespace seam
