#pragma once
/// Whose a body is in a scene, whatever a method makes of it: what "another player's" means for all
/// methods alike.

#include <map>

#include "common/physics/world.h"

namespace seam {

/// By assembly id, of a world at tick 0: the player that Part::owner names, else the one whose
/// vehicle it is part of, else the one in whose region it begins. Bodies of nobody are absent.
std::map<PartId, int> FindOwners(const World& world);

/// Whether, in the last tick, bodies of two players touched. Bodies that `owners` lacks count for
/// nobody.
bool OwnersTouch(const World& world, const std::map<PartId, int>& owners);

}  // namespace seam
