#pragma once
/// Finds free connectors, and the bond that two of them make.

#include <vector>

#include "common/scene/assembly.h"
#include "common/topology/edit.h"

namespace seam {

/// Returns true if any part that is there has connectors.
bool HasConnectors(const Scene& scene);

struct FreeConnector {
  PartId part = 0;
  bool inlet = false;
  int index = 0;    ///< into the part's inlets or outlets
  Vec2 at{0, 0};    ///< m, in the scene
  float angle = 0;  ///< rad, in the scene
};

/// Returns the connectors with no counterpart of the same assembly in place, ascending by part.
std::vector<FreeConnector> FreeConnectors(const Scene& scene, const Composition& composition);

/// Returns the bond that puts `a`'s outlet into `b`'s inlet: at one position, facing each other.
BondEdit JoinOf(const Part& a, int outlet, const Part& b, int inlet);

/// Returns true if a bond equals the one that two free connectors of its parts would make.
bool IsJoin(const Scene& scene, const Composition& composition, const BondEdit& bond);

}  // namespace seam
