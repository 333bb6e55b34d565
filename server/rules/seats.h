#pragma once
/// Seats: who presses a seat's button beside it gets in, who presses it in there gets out. Decided
/// by the server alone, from its own world.

#include <vector>

#include "common/physics/world.h"
#include "common/topology/edit.h"

namespace seam {

/// What a player's buttons that went down (a bit field) change about who sits where.
std::vector<Edit> SeatEdits(const World& world, int player, int pressed);

}  // namespace seam
