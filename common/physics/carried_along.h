#pragma once
/// Moves a mechanism along with a bond: if the bond moves one of its bodies, the rest of the
/// mechanism makes the same rigid motion, so that no limb stays behind.

#include <vector>

#include "common/scene/assembly.h"

namespace seam {

/// Bodies at one time: their composition, their parts' places in the scene, and their states.
struct PlacedBodies {
  const Composition& composition;
  const std::vector<Part>& parts;
  const std::vector<BodyState>& states;  ///< by moving assembly, ascending by id
};

/// Returns, by current body, the motion that brings it back to its mechanism. It is zero except for
/// unchanged bodies of a mechanism with another body that was bonded to another mechanism, or to
/// something anchored, and was moved by that. Empty if no body is to be moved.
std::vector<BodyState> CarriedAlong(const PlacedBodies& before, const PlacedBodies& now);

}  // namespace seam
