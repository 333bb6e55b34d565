#pragma once
/// Plausibility of impacts and touches, by the states that the authorities of both bodies reported.

#include <cstdint>

#include "common/physics/world.h"
#include "server/rules/rule_source.h"
#include "server/rules/state_trail.h"

namespace seam {

/// True if a reported impact in a tick is possible. The point must be at both bodies. The struck
/// body's velocity must not change by more than momentum explains: that of the other body's
/// mechanism (for anchored parts, of its own) at their relative speed just before. False also if
/// nothing is known of one of the bodies yet.
bool Possible(const World& world, const StateTrail& trail, const Blow& blow, std::int64_t tick);

/// True if the bodies of two parts, which exist, may have touched around a tick. Each counts as a
/// disc about its root.
bool MayTouch(const World& world, const StateTrail& trail, const PartTouch& touch,
              std::int64_t tick);

}  // namespace seam
