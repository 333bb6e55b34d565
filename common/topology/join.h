#pragma once
/// Connectors that are free, and the bond that two of them make.

#include <vector>

#include "common/scene/assembly.h"
#include "common/topology/edit.h"

namespace seam {

/// Whether any part has connectors.
bool HasConnectors(const Scene& scene);

struct FreeConnector {
  PartId part = 0;
  bool inlet = false;
  int index = 0;    ///< of the part's inlets or outlets
  Vec2 at{0, 0};    ///< m, where the scene puts it
  float angle = 0;  ///< rad, likewise
};

/// Those that no counterpart of the same assembly is at, ascending by part.
std::vector<FreeConnector> FreeConnectors(const Scene& scene, const Composition& composition);

/// The bond by which `b`'s inlet takes `a`'s outlet: at one position, facing each other.
BondEdit JoinOf(const Part& a, int outlet, const Part& b, int inlet);

/// Whether a bond is what two free connectors of its parts would make.
bool IsJoin(const Scene& scene, const Composition& composition, const BondEdit& bond);

}  // namespace seam
