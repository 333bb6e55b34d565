#pragma once
/// Refuses scenes with so many overlapping shapes that the first ticks would take minutes.

#include <cstddef>
#include <cstdint>
#include <string>

#include "common/scene/assembly.h"

namespace seam {

/// Number of shape pairs that overlap at the start (by world-axis-aligned boxes) and may collide:
/// of different assemblies, at least one moving, not excluded by a group or a joint. A part that
/// the engine receives in pieces (a capsule, a large polygon, a chain's segments) counts by its
/// pieces.
struct Crowding {
  std::int64_t pairs = 0;         ///< pairs without a bullet
  std::int64_t bullet_pairs = 0;  ///< pairs with a bullet, both moving
  PartId part = -1;               ///< part with the most pairs, if any
  PartId bullet_part = -1;        ///< part with the most pairs with a bullet
};

/// Counts the pairs whose later part is `first` or after it. With `first` above 0, earlier parts
/// count only if they never move: the scene does not know the current place of moving parts.
Crowding CrowdingOf(const Scene& scene, const Composition& composition, PartId first = 0);

/// Throws OperatorError "FILE:LINE: ..." if the pairs exceed kCrowdMax or kBulletCrowdMax.
void CheckCrowding(const Scene& scene, const Composition& composition, const std::string& file,
                   PartId first = 0);

}  // namespace seam
