#pragma once
/// Bodies that a player drives, and therefore sees without network delay.

#include <vector>

#include "common/physics/world.h"

namespace seam {

/// Returns, by body, true if its mechanism holds the player's vehicle, a character of the player, a
/// part with the player as Part::owner, or a part with a seat on which the player sits.
std::vector<bool> DrivenBy(const World& world, int player);

}  // namespace seam
