/// Server: players that enter or leave seats, and the bonds that follow.

#include <algorithm>
#include <set>

#include "server/rules/seats.h"
#include "server/server.h"

namespace seam {

void Server::RunSeats() {
  const World& world = replica_.world();
  if (world.scene().seats.empty()) return;
  std::set<int> taken;  // the first in the order of players gets it
  for (int p = 0; p < static_cast<int>(scene_.players.size()); ++p) {
    const int pressed = replica_.TakePressed(p);
    for (const Edit& edit : SeatEdits(world, p, pressed, &taken)) edits_->Add(edit);
  }
  int heard = replica_.revision();
  if (!config_.sync.policy->IsOracle()) {  // in mode oracle all peers act at the same tick
    // Waits for joining clients, too.
    sessions_.ForEachSentRoom([&](const Session& s) { heard = std::min(heard, s.revision); });
  }
  for (const Edit& edit : seat_bonds_.Next(world, heard)) edits_->Add(edit);
}

}  // namespace seam
