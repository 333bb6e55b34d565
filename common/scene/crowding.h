#pragma once
/// Refuses scenes in which so much begins in one place that the first ticks would take minutes.

#include <cstddef>
#include <cstdint>
#include <string>

#include "common/scene/assembly.h"

namespace seam {

/// Pairs of shapes whose boxes (along the world's axes) overlap where the scene puts them, and that
/// may collide: of different assemblies, at least one of which moves, not kept apart by a group or
/// a joint. A part that the engine gets in pieces (a capsule, a large polygon, a chain's segments)
/// counts as its pieces.
struct Crowding {
  std::int64_t pairs = 0;         ///< without a bullet
  std::int64_t bullet_pairs = 0;  ///< with one, both moving
  PartId part = -1;               ///< that is in most of the pairs, if there are any
  PartId bullet_part = -1;        ///< that is in most of the pairs with a bullet
};

/// Counts pairs in which the later part is `first` or after it. With `first` above 0, of the parts
/// before it only those count that never move: where the others are by now, a scene does not say.
/// A sweep along the axis on which the parts are spread more: O(n log n + pairs that overlap
/// there).
Crowding CrowdingOf(const Scene& scene, const Composition& composition, PartId first = 0);

/// Throws OperatorError "FILE:LINE: ..." when there are more than kCrowdMax or kBulletCrowdMax.
void CheckCrowding(const Scene& scene, const Composition& composition, const std::string& file,
                   PartId first = 0);

}  // namespace seam
