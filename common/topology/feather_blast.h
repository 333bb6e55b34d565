#pragma once
/// Computes the bricks that a blast sets free, and the parts that they become.

#include <vector>

#include "common/scene/bricks.h"
#include "common/scene/charges/charge.h"
#include "common/scene/scene.h"
#include "common/topology/edit.h"
#include "common/topology/feather_store.h"

namespace seam {

/// Most parts from one blast, so that a blast of any size stays affordable for every peer.
constexpr int kBlastPiecesMax = 40;

struct Blast {
  Vec2 centre{0, 0};  ///< m
  float radius = 1;   ///< m: brick centres within it
  float speed = 10;   ///< m/s in the centre, falling to 0 at the radius
  float impulse = 0;  ///< N s for each metre of a body's silhouette, falling likewise
};

inline Blast BlastOf(const BlastEdit& e) { return {e.centre, e.radius, e.speed, e.impulse}; }

struct Freed {
  std::vector<Brick> bricks;  ///< no longer anchored
  std::vector<Part> parts;    ///< boxes of up to two by two of them; without ids
};

/// Each side of a freed part is smaller by this than its bricks, m, so that it can leave its hole:
/// shapes come to rest 1.5 cm apart, and bricks lie without a gap. Its mass is that of the bricks.
constexpr float kFreedGap = 0.015f;

/// Returns a part without id, at rest: `columns` by `rows` bricks, `first` at the lower left.
Part FreedPart(const BrickField& field, const Brick& first, int columns, int rows);

/// Selects the bricks of `left` that the blast would give a speed above their strength, and groups
/// them into pieces, nearest first. At most kBlastPiecesMax pieces; further bricks stay in place.
/// Depends on nothing but its arguments: the same on every peer. Cost: a search of the bricks near
/// the blast.
Freed BlastBricks(const FeatureList<BrickField>& fields, const FeatherStore& left,
                  const Blast& blast);

/// Returns all bricks that have become parts, in the order of the parts, parts that have left
/// included. A freed part is named after its bricks: "towers@-120,35+2x2" is two by two bricks of
/// `towers` whose lower left corner is at (-120, 35) units. No name in a scene contains an @.
std::vector<Brick> FreedBricks(const FeatureList<BrickField>& fields,
                               const std::vector<Part>& parts);

/// Largest distance of a blast's centre from the origin, along x and along y, m.
constexpr float kBlastPlaceMax = 1e6f;

/// Returns true if a blast is within kBlastPlaceMax, kBlastRadiusMax, kSpeedMax and
/// kBlastImpulseMax.
bool Possible(const Blast& blast);

}  // namespace seam
