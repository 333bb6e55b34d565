#pragma once
/// Seats: who presses a seat's button beside it gets in, who presses it in there gets out. Decided
/// by the server alone, from its own world.

#include <vector>

#include "common/physics/world.h"
#include "common/topology/edit.h"

namespace seam {

/// Bonds whoever has taken a seat to it, once the way there is over (MakeSeatStage).
class SeatBonds {
 public:
  /// Called once after each tick.
  std::vector<Edit> Next(const World& world);

 private:
  std::vector<int> waited_;    // ticks, by seat
  std::vector<PartId> asked_;  // by seat: whose bond was asked for, -1: nobody's
};

/// What a player's buttons that went down (a bit field) change about who sits where.
std::vector<Edit> SeatEdits(const World& world, int player, int pressed);

}  // namespace seam
