#pragma once
/// What holds a scene's bricks up: the places where they lie on anchored parts, and of a building
/// that lies on none, its own lowest rows.

#include <cstddef>
#include <vector>

#include "common/scene/bricks.h"
#include "common/scene/feature.h"
#include "common/scene/scene.h"
#include "common/topology/feather_store.h"

namespace seam {

/// mm: bricks lie on a part that is no further below them: one unit of theirs.
constexpr int kRestGap = 50;
/// mm: what reaches below or into a brick by less, from its side, holds it not.
constexpr int kRestSide = 10;

/// A building is what common edges connect in the scene as it begins, of whichever [[bricks]].
///
///     |--------deck--------|
///       |pier|    |lamp|  |steps      The pier holds all: it lies on a part. Without that part,
///       |    |            |______     pier and steps would hold it, since the scene hangs it in
///     =ground==                       the air; the lamp would not if there were bricks below it.
///
/// Where a building lies on anchored parts (on a face of theirs that looks up), the bricks that do
/// are its foundations, in whichever row, and no others. Each holds as long as one of the parts
/// that it lies on is there and anchored. A building that lies on none stands by the lowest row of
/// each of its [[bricks]] (of each of their towers), unless that row touches some that begin lower,
/// or others of the building lie straight below it.
///
/// Faces are rounded to a millimetre, all else are integers: the same on every peer.
class Foundations {
 public:
  /// `whole`: all bricks of the scene; `ground`: its parts that are anchored and stand still, by
  /// ascending id. Costs a look at the bricks along their faces, and at each building.
  Foundations(const FeatherStore& whole, const FeatureList<BrickField>& fields,
              const std::vector<Part>& ground);

  /// Whether the brick is a foundation, with the scene's parts as they are now.
  bool Holds(const Brick& brick, const std::vector<Part>& parts) const;

  /// The bricks that lie on a part, ascending by kind, y, x; none if it is no ground.
  std::vector<Brick> On(PartId part) const;

 private:
  struct Rest {
    Brick brick;
    PartId part = 0;
  };

  /// Index of the brick's tower, or rectangle.
  std::size_t TowerOf(const Brick& brick) const;

  FeatureList<BrickField> fields_;
  std::vector<std::size_t> first_;  // by field: index of its first tower in by_itself_
  std::vector<bool> by_itself_;     // by tower: its lowest row is a foundation
  std::vector<Rest> rests_;         // ascending by kind, y, x, part
};

}  // namespace seam
