#pragma once
/// A cell's bricks as fixtures of one static body.

#include <box2d/box2d.h>

#include "common/physics/feather_store.h"

namespace seam {

/// One chain per outline, on a body without user data at the cell's corner. `skin`: of the scene's
/// solver; the surface is moved in as that of other anchored things. `first_id`: user data of the
/// first fixture, ascending. nullptr if the cell has no boundary.
b2Body* AddChunk(const FeatherStore& store, int cell_x, int cell_y, float skin,
                 std::uintptr_t first_id, b2World* world);

}  // namespace seam
