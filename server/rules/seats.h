#pragma once
/// Seats: who presses a seat's button beside it gets in, who presses it in there gets out. Decided
/// by the server alone, from its own world.

#include <set>
#include <vector>

#include "common/physics/world.h"
#include "common/topology/edit.h"

namespace seam {

/// Bonds whoever has taken a seat to it, once the way there is over (MakeSeatStage).
class SeatBonds {
 public:
  /// Called once after each tick. `heard`: how many edits the last of the peers has applied.
  std::vector<Edit> Next(const World& world, int heard);

 private:
  /// One seat's, while somebody is on the way there or sits there.
  struct Way {
    PartId own = -1;    // whose; -1: nobody's
    int revision = 0;   // with which it was taken
    int ticks = 0;      // since then
    int heard_at = -1;  // of these, when all peers had heard of it; -1: not yet
  };
  int Due(const World& world, std::size_t seat) const;

  std::vector<Way> ways_;      // by seat
  std::vector<PartId> asked_;  // by seat: whose bond was asked for, -1: nobody's
};

/// What a player's buttons that went down (a bit field) change about who sits where. `taken`: seats
/// that others have taken by edits that the world has not had yet; what this player takes is added.
std::vector<Edit> SeatEdits(const World& world, int player, int pressed, std::set<int>* taken);

}  // namespace seam
