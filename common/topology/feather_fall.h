#pragma once
/// Bricks that nothing holds up any more: what a blast leaves in the air comes down. No statics:
/// what is connected to a foundation stands.

#include <vector>

#include "common/scene/bricks.h"
#include "common/topology/feather_blast.h"
#include "common/topology/feather_store.h"
#include "common/topology/foundation.h"

namespace seam {

/// Parts that one edit lets fall, the most; what is left falls by the next edit.
constexpr int kFallPiecesMax = 100;
/// Units: a piece is no larger along x or y, unless a single brick is.
constexpr int kFallSideMax = 30;

struct Fallen {
  std::vector<Part> parts;     ///< boxes of neighbours of one kind, at rest; without ids
  std::vector<Brick> hanging;  ///< that nothing holds up either
};

/// The bricks of `left` near the blast, and next to what it freed, that no row of neighbours (by a
/// common edge, however short) connects to a foundation, and what is known to hang: from below, at
/// most kFallPiecesMax pieces. `parts`: the scene's, as they are now.
/// Integer arithmetic: the same on every peer. Costs a walk over what hangs, and from what stands
/// down to its foundation.
Fallen FallingBricks(const FeatureList<BrickField>& fields, const Foundations& foundations,
                     const std::vector<Part>& parts, const FeatherStore& left,
                     const std::vector<Brick>& freed, const Blast& blast);

/// The bricks of `left` that hang when a part that they lay on has left or is freed, and what is
/// known to hang: ascending by kind, y, x. `parts`: without it. Costs as much.
std::vector<Brick> HangingWithout(PartId part, const Foundations& foundations,
                                  const std::vector<Part>& parts, const FeatherStore& left);

}  // namespace seam
