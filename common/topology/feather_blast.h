#pragma once
/// Bricks that a blast sets free: what they were, and the parts that they become.

#include <vector>

#include "common/scene/bricks.h"
#include "common/scene/scene.h"
#include "common/topology/feather_store.h"

namespace seam {

/// Parts from one blast, the most: a blast of any size stays affordable for every peer.
constexpr int kBlastPiecesMax = 40;
/// m
constexpr float kBlastRadiusMax = 10;

struct Blast {
  Vec2 centre{0, 0};  ///< m
  float radius = 1;   ///< m: bricks whose middle is within it
  float speed = 10;   ///< m/s in the centre, falling to 0 at the radius
};

struct Freed {
  std::vector<Brick> bricks;  ///< no longer anchored
  std::vector<Part> parts;    ///< boxes of up to two by two of them; without ids
};

/// The bricks of `fields` but `gone` that the blast would give a speed above their strength,
/// nearest first, as pieces; and no more pieces than kBlastPiecesMax, the rest stays where it is.
/// A function of its arguments: the same on every peer. Costs a walk over all bricks (3 ms for a
/// million).
Freed BlastBricks(const FeatureList<BrickField>& fields, const std::vector<Brick>& gone,
                  const Blast& blast);

/// All bricks that have become parts: a piece is named after what it was, "towers@-120,35+2x2" for
/// two by two bricks of `towers` whose lower left corner is at (-120, 35) units. No name in a scene
/// has an @. In the order of the parts, those that have left included.
std::vector<Brick> FreedBricks(const FeatureList<BrickField>& fields,
                               const std::vector<Part>& parts);

/// Whether a blast is one that can be: finite, of at most kBlastRadiusMax and kSpeedMax.
bool Possible(const Blast& blast);

}  // namespace seam
