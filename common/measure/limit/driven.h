#pragma once
/// What a player drives itself, and so sees without a delay of the network.

#include <vector>

#include "common/physics/world.h"

namespace seam {

/// By body: whether its mechanism holds the player's vehicle, a character of the player's, a part
/// that Part::owner gives it, or the part with a seat on which the player sits.
std::vector<bool> DrivenBy(const World& world, int player);

}  // namespace seam
