#pragma once
/// Lets bricks fall that nothing supports any more, such as the remains of a blast in the air. No
/// statics: bricks connected to a foundation stand.

#include <vector>

#include "common/scene/bricks.h"
#include "common/topology/feather_blast.h"
#include "common/topology/feather_store.h"
#include "common/topology/foundation.h"

namespace seam {

/// Most parts that one edit lets fall; further bricks fall by the next edit.
constexpr int kFallPiecesMax = 100;
/// Largest side of a piece along x or y, units, unless a single brick is larger.
constexpr int kFallSideMax = 30;

struct Fallen {
  std::vector<Part> parts;     ///< boxes of neighbours of one kind, at rest; without ids
  std::vector<Brick> hanging;  ///< further unsupported bricks, still in place
};

/// Lets fall, from below and as at most kFallPiecesMax pieces, the bricks of `left` that no chain
/// of neighbours (sharing an edge, however short) connects to a foundation. Searches the bricks
/// near the blast, the neighbours of the bricks that it freed, and the bricks known to hang.
/// `parts`: the scene's current parts.
/// Integer arithmetic: the same on every peer. Cost: a walk over all hanging bricks, and from each
/// standing brick down to its foundation.
Fallen FallingBricks(const FeatureList<BrickField>& fields, const Foundations& foundations,
                     const std::vector<Part>& parts, const FeatherStore& left,
                     const std::vector<Brick>& freed, const Blast& blast);

/// Returns the bricks of `left` that hang once a part below them has left or been freed, and the
/// bricks known to hang: ascending by kind, y, x. `parts`: without that part. Cost: as
/// FallingBricks.
std::vector<Brick> HangingWithout(PartId part, const Foundations& foundations,
                                  const std::vector<Part>& parts, const FeatherStore& left);

}  // namespace seam
