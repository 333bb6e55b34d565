#pragma once
/// Keeps extrapolated bodies from passing through anchored shapes. Ground is often a line; a body
/// below it falls forever, also at its authority once that is this peer.

#include <cstdint>

#include "common/physics/world.h"
#include "common/sync/body_memory.h"

namespace seam {

/// Returns the point nearest to `target` that a copy can reach without crossing an anchored shape,
/// if its authority had it at `heard` at tick `from`.
Vec2 WayTo(const World& world, const BodyMemory& memory, int body, const Vec2& heard,
           std::int64_t from, const Vec2& target);

}  // namespace seam
