#pragma once
/// Computes how a bond moves one assembly onto another.

#include "common/base/geometry.h"
#include "common/scene/assembly.h"
#include "common/topology/edit.h"

namespace seam {

/// Returns a part's pose in the scene.
inline Transform2 PlaceOf(const Part& part) {
  return {part.position.cast<double>(), static_cast<double>(part.angle)};
}

/// The assembly that a bond moves, and its motion.
struct BondMove {
  int assembly = 0;  ///< index of the assembly that is not anchored; b's if neither is
  Transform2 moves;
};

/// Requires existing parts in two different assemblies.
BondMove MoveOf(const Scene& scene, const Composition& composition, const BondEdit& bond);

/// Returns true if all parts of both assemblies stay where shapes are numerically sound: near their
/// body's origin, and within kPlaceMax and kTurnMax. Requires the same as MoveOf.
bool FitsTogether(const Scene& scene, const Composition& composition, const BondEdit& bond);

}  // namespace seam
