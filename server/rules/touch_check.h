#pragma once
/// Plausibility of touches, by the states that the authorities of both bodies reported.

#include <cstdint>

#include "common/physics/world.h"
#include "server/rules/state_trail.h"

namespace seam {

/// True if the bodies of two parts, which exist, may have touched around a tick. Each counts as a
/// disc about its root.
bool MayTouch(const World& world, const StateTrail& trail, const PartTouch& touch,
              std::int64_t tick);

}  // namespace seam
