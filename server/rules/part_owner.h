#pragma once
/// Player that owns a mechanism.

#include "common/physics/part_places.h"

namespace seam {

/// Returns the player that has its vehicle in the mechanism, else the mechanism's owner; -1:
/// nobody.
inline int PlayerOf(const World& world, int mechanism) {
  if (mechanism < 0) return -1;
  const std::vector<Player>& players = world.scene().players;
  for (std::size_t p = 0; p < players.size(); ++p) {
    if (players[p].vehicle >= 0 && MechanismOf(world, players[p].vehicle) == mechanism) {
      return static_cast<int>(p);
    }
  }
  return world.composition().mechanisms[static_cast<std::size_t>(mechanism)].owner;
}

}  // namespace seam
