#pragma once
/// Foundations of a scene's bricks: places where they lie on anchored parts; for a building that
/// lies on none, its own lowest rows.

#include <cstddef>
#include <vector>

#include "common/scene/bricks.h"
#include "common/scene/feature.h"
#include "common/scene/scene.h"
#include "common/topology/feather_store.h"

namespace seam {

/// Bricks lie on a part up to this far below them, mm: one of their units.
constexpr int kRestGap = 50;
/// A part that reaches below or into a brick from its side by less than this, mm, does not support
/// it.
constexpr int kRestSide = 10;

/// A building: all bricks, of any [[bricks]], connected by common edges at the start of the scene.
///
///     |--------deck--------|
///       |pier|    |lamp|  |steps      The pier holds all: it lies on a part. Without that part,
///       |    |            |______     pier and steps would hold it, since the scene hangs it in
///     =ground==                       the air; the lamp would not if there were bricks below it.
///
/// If a building lies on anchored parts (on their upward faces), exactly the bricks that do are its
/// foundations, in any row. Each holds as long as one of the parts below it exists and is anchored.
/// A building on no such part stands by the lowest row of each of its [[bricks]] (of each tower),
/// unless that row touches bricks of a field that begins lower, or other bricks of the building lie
/// directly below it.
///
/// Faces are rounded to a millimetre, all other numbers are integers: the same on every peer.
class Foundations {
 public:
  /// `whole`: all bricks of the scene; `ground`: its anchored, motionless parts, by ascending id.
  /// Cost: a search along their faces, and a visit of each building.
  Foundations(const FeatherStore& whole, const FeatureList<BrickField>& fields,
              const std::vector<Part>& ground);

  /// Returns true if the brick is a foundation, given the scene's current parts.
  bool Holds(const Brick& brick, const std::vector<Part>& parts) const;

  /// Returns the bricks that lie on a part, ascending by kind, y, x; none if the part is not
  /// ground.
  std::vector<Brick> On(PartId part) const;

 private:
  struct Rest {
    Brick brick;
    PartId part = 0;
  };

  /// Returns the index of the brick's tower, or rectangle.
  std::size_t TowerOf(const Brick& brick) const;

  FeatureList<BrickField> fields_;
  std::vector<std::size_t> first_;    // by field: index of its first tower in own_foundation_
  std::vector<bool> own_foundation_;  // by tower: its lowest row is a foundation
  std::vector<Rest> rests_;         // ascending by kind, y, x, part
};

}  // namespace seam
