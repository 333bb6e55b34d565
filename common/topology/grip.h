#pragma once
/// Grips: a character's hand holds what it touches by a hinge, which is a bond like others: an edit
/// makes it (BondCause::kGrip), an edit breaks it. It lets go above its strength.

#include <optional>

#include "common/scene/scene.h"
#include "common/topology/edit.h"

namespace seam {

/// Whether the joint is a grip. What a scene file makes is none.
inline bool IsGrip(const Joint& joint) {
  return joint.kind == JointKind::kRevolute && joint.strength > 0;
}

/// Index of the character whose lower arm the part is; -1: it is nobody's.
int CharacterOfHand(const Scene& scene, PartId part);

/// The fingertip of a lower arm, m, in the part's own frame: as far beyond its middle as the elbow
/// is before it. nullopt: the part is no character's lower arm, or has been severed.
std::optional<Vec2> FingertipOf(const Scene& scene, PartId hand);

/// N; the weight of the whole character, which is the most that a grip of it holds.
float GripStrength(const Scene& scene, int character);

/// Whether the bond is a grip that may be: of a character that has them, on another thing, of that
/// strength.
bool MayGrip(const Scene& scene, const BondEdit& bond);

}  // namespace seam
