#pragma once
/// What a bond carries along: where it moves one body of a mechanism, the rest of the mechanism
/// makes the same rigid motion, so that no limb stays behind.

#include <vector>

#include "common/scene/assembly.h"

namespace seam {

/// Bodies at one time: who they are, where the scene puts their parts, and where they lie.
struct PlacedBodies {
  const Composition& composition;
  const std::vector<Part>& parts;
  const std::vector<BodyState>& states;  ///< by moving assembly, ascending by id
};

/// By body as they are now: the motion from where it lies to where it belongs. Not zero only for
/// bodies that are the same as before, and whose mechanism has another body that was bonded to
/// another mechanism, or to what is anchored, and lies elsewhere now. Empty: none is to be moved.
std::vector<BodyState> CarriedAlong(const PlacedBodies& before, const PlacedBodies& now);

}  // namespace seam
