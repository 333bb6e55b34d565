#pragma once
/// Ownership of bodies by the scene alone: defines "another player's body" alike for all methods,
/// independent of authority.

#include <map>

#include "common/physics/world.h"

namespace seam {

/// Returns the owning player by assembly id, of a world at tick 0: the player named by Part::owner,
/// else the player of the vehicle in the same mechanism, else the player of the region in which the
/// body begins. Bodies without an owner are absent.
std::map<PartId, int> FindOwners(const World& world);

/// True if bodies of two different players touched in the last tick. Ignores bodies that are not in
/// `owners`.
bool OwnersTouch(const World& world, const std::map<PartId, int>& owners);

}  // namespace seam
