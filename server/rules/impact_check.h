#pragma once
/// Whether an impact can have happened, by what the authorities of its two bodies told of them.

#include <cstdint>

#include "common/physics/world.h"
#include "server/rules/rule_source.h"
#include "server/rules/state_trail.h"

namespace seam {

/// Whether a blow in a tick can be: the point is at both bodies, and the struck one's velocity
/// changes by no more than the momentum explains that the other (or, of anchored things, its own
/// mechanism) brought with their relative speed just before. False as well when nothing is known
/// of one of them yet.
bool Possible(const World& world, const StateTrail& trail, const Blow& blow, std::int64_t tick);

}  // namespace seam
