#pragma once
/// Seats: a player who presses a seat's button beside it gets in, and pressing it inside gets out.
/// The server alone decides, from its own world.

#include <set>
#include <vector>

#include "common/physics/world.h"
#include "common/topology/edit.h"

namespace seam {

class StateArchive;

/// Bonds a player's part to its seat once it has moved there (MakeSeatStage).
class SeatBonds {
 public:
  /// Returns the edits that are due: bonds of parts that have arrived, and releases of seats that
  /// were not reached in time. Call once after each tick. `heard`: number of edits that all peers
  /// have applied; below 0 while a peer is joining.
  std::vector<Edit> Next(const World& world, int heard);
  void Persist(StateArchive& a, const World& world);

 private:
  /// State of one seat, from the taking of the seat until it is left.
  struct Way {
    PartId own = -1;    // player's part; -1: the seat is free
    int revision = 0;   // at which the seat was taken
    int ticks = 0;      // since then
    int heard_at = -1;  // `ticks` when all peers had that edit; -1: not yet
  };
  int Due(const World& world, std::size_t seat) const;

  std::vector<Way> ways_;      // by seat
  std::vector<PartId> asked_;  // by seat: part with a requested bond, -1: none
};

/// Returns the edits by which the player of a taken seat gets out of it.
std::vector<Edit> LeaveSeat(const World& world, int seat);

/// A seat that a player asked for and did not get.
struct SeatRefusal {
  int seat = -1;      ///< index in the scene; -1: none was refused
  int taken_by = -1;  ///< player in the seat; -1: it is out of reach
  float away = 0;     ///< m, from the player's own part
};

/// Returns the seat for which a player has pressed in vain: the nearest one with such a button.
/// Call if SeatEdits has returned no edits. `taken`: as there.
SeatRefusal RefusedSeat(const World& world, int player, int pressed, const std::set<int>& taken);

/// Returns the edits that result from the buttons a player has just pressed (a bit field). `taken`:
/// seats taken by edits that the world has not applied yet; a seat that this player takes is added.
std::vector<Edit> SeatEdits(const World& world, int player, int pressed, std::set<int>* taken);

}  // namespace seam
