#pragma once
/// Bricks that nothing holds up any more: what a blast leaves in the air comes down. No statics:
/// what is connected to a foundation stands.

#include <vector>

#include "common/scene/bricks.h"
#include "common/topology/feather_blast.h"
#include "common/topology/feather_store.h"

namespace seam {

/// Parts that one edit lets fall, the most; what is left falls by the next edit.
constexpr int kFallPiecesMax = 100;
/// Units: a piece is no larger along x or y, unless a single brick is.
constexpr int kFallSideMax = 30;

/// By kind, whether its lowest row is a foundation: unless that row touches bricks of another kind
/// that begin lower. So a wall, a street and what a scene hangs in the air stand by themselves, and
/// a roof on two walls by these. `whole`: all bricks of the scene.
std::vector<bool> FoundedKinds(const FeatherStore& whole, const FeatureList<BrickField>& fields);

struct Fallen {
  std::vector<Part> parts;     ///< boxes of neighbours of one kind, at rest; without ids
  std::vector<Brick> hanging;  ///< that nothing holds up either
};

/// The bricks of `left` near the blast, and next to what it freed, that no row of neighbours (by a
/// common edge, however short) connects to a foundation, and what is known to hang: from below, at
/// most kFallPiecesMax pieces.
/// Integer arithmetic: the same on every peer. Costs a walk over what hangs, and from what stands
/// down to its foundation.
Fallen FallingBricks(const FeatureList<BrickField>& fields, const std::vector<bool>& founded,
                     const FeatherStore& left, const std::vector<Brick>& freed, const Blast& blast);

}  // namespace seam
