#pragma once
/// Bricks that a blast sets free: what they were, and the parts that they become.

#include <vector>

#include "common/scene/bricks.h"
#include "common/scene/charges/charge.h"
#include "common/scene/scene.h"
#include "common/topology/edit.h"
#include "common/topology/feather_store.h"

namespace seam {

/// Parts from one blast, the most: a blast of any size stays affordable for every peer.
constexpr int kBlastPiecesMax = 40;

struct Blast {
  Vec2 centre{0, 0};  ///< m
  float radius = 1;   ///< m: bricks whose middle is within it
  float speed = 10;   ///< m/s in the centre, falling to 0 at the radius
  float impulse = 0;  ///< N s for each metre of a body's silhouette, falling likewise
};

inline Blast BlastOf(const BlastEdit& e) { return {e.centre, e.radius, e.speed, e.impulse}; }

struct Freed {
  std::vector<Brick> bricks;  ///< no longer anchored
  std::vector<Part> parts;    ///< boxes of up to two by two of them; without ids
};

/// m: a part is smaller by this on each side than the bricks that it was, so that it can leave its
/// hole: shapes come to rest 1.5 cm apart, and bricks lie without a gap. Its mass is theirs.
constexpr float kFreedGap = 0.015f;

/// So many columns and rows of bricks from `first`, its lower left, as a part without id, at rest.
Part FreedPart(const BrickField& field, const Brick& first, int columns, int rows);

/// Those of the bricks `left` of `fields` that the blast would give a speed above their strength,
/// nearest first, as pieces; and no more pieces than kBlastPiecesMax, the rest stays where it is.
/// A function of its arguments: the same on every peer. Costs a look at what is near.
Freed BlastBricks(const FeatureList<BrickField>& fields, const FeatherStore& left,
                  const Blast& blast);

/// All bricks that have become parts: a piece is named after what it was, "towers@-120,35+2x2" for
/// two by two bricks of `towers` whose lower left corner is at (-120, 35) units. No name in a scene
/// has an @. In the order of the parts, those that have left included.
std::vector<Brick> FreedBricks(const FeatureList<BrickField>& fields,
                               const std::vector<Part>& parts);

/// m that a blast's centre is from the origin at most, along x and along y.
constexpr float kBlastPlaceMax = 1e6f;

/// Whether a blast is one that can be: of at most kBlastPlaceMax, kBlastRadiusMax, kSpeedMax and
/// kBlastImpulseMax.
bool Possible(const Blast& blast);

}  // namespace seam
