#pragma once
/// Snapshots of one world as bytes, one after another: most of it is at rest.

#include "common/physics/world.h"

namespace seam {

/// Like Persist, in few bytes where the snapshot is like the one `before`, which has been read when
/// this one is.
void PersistAfter(StateArchive& a, const WorldSnapshot& before, WorldSnapshot* snapshot);

}  // namespace seam
