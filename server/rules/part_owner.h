#pragma once
/// Player that owns a mechanism.

#include "common/physics/part_places.h"
#include "common/scene/ownership.h"

namespace seam {

/// Returns the player that has its vehicle in the mechanism, else the mechanism's owner; -1:
/// nobody.
inline int PlayerOf(const World& world, int mechanism) {
  if (mechanism < 0) return -1;
  const int player = VehicleOwner(world.scene(), world.composition(), mechanism);
  if (player >= 0) return player;
  return world.composition().mechanisms[static_cast<std::size_t>(mechanism)].owner;
}

}  // namespace seam
