#pragma once
/// How a bond puts the places of two assemblies together.

#include "common/base/geometry.h"
#include "common/scene/assembly.h"
#include "common/topology/edit.h"

namespace seam {

/// Where the scene puts a part.
inline Transform2 PlaceOf(const Part& part) {
  return {part.position.cast<double>(), static_cast<double>(part.angle)};
}

/// What a bond moves, and how.
struct BondMove {
  int assembly = 0;  ///< index; the side that is not anchored; b's if neither is
  Transform2 moves;
};

/// Requires parts that are there, and two assemblies.
BondMove MoveOf(const Scene& scene, const Composition& composition, const BondEdit& bond);

/// Whether all parts of both sides stay where shapes are sound: near their body's origin, and
/// within kPlaceMax and kTurnMax. Requires what MoveOf does.
bool FitsTogether(const Scene& scene, const Composition& composition, const BondEdit& bond);

}  // namespace seam
