#pragma once
/// Maps a player's pressed buttons to actions on mechanisms.

#include <cstddef>
#include <vector>

#include "common/physics/part_places.h"
#include "common/physics/world.h"

namespace seam {

/// Calls `visit(action, mechanism)` for each action of the player with a button in `pressed` and a
/// part that is still in a mechanism.
template <class Visit>
void EachAction(const World& world, int player, int pressed, const Visit& visit) {
  if (pressed == 0) return;
  const std::vector<Action>& actions =
      world.scene().players[static_cast<std::size_t>(player)].actions;
  for (std::size_t a = 0; a < actions.size(); ++a) {
    if (((pressed >> actions[a].button) & 1) == 0) continue;
    const int m = MechanismOf(world, actions[a].part);
    if (m >= 0) visit(static_cast<int>(a), m);
  }
}

}  // namespace seam
