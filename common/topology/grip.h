#pragma once
/// Grips: a character's hand holds a part by a hinge. A grip is a bond: an edit makes it
/// (BondCause::kGrip), an edit breaks it. It breaks under a force above its strength.

#include <optional>

#include "common/scene/scene.h"
#include "common/topology/edit.h"

namespace seam {

/// Returns true if the joint is a grip. Joints of a scene file never are.
inline bool IsGrip(const Joint& joint) {
  return joint.kind == JointKind::kRevolute && joint.strength > 0;
}

/// Returns the index of the character that owns this lower arm; -1 if it is no lower arm.
int CharacterOfHand(const Scene& scene, PartId part);

/// Returns the fingertip of a lower arm, m, in the part's frame: as far beyond its middle as the
/// elbow is before it. nullopt if the part is no character's lower arm, or is severed.
std::optional<Vec2> FingertipOf(const Scene& scene, PartId hand);

/// Returns the strength of a grip, N: the weight of the whole character.
float GripStrength(const Scene& scene, int character);

/// Returns true if the bond is a permitted grip: by a free hand of a character that may grip, on a
/// part that is not its own, with the right strength.
bool MayGrip(const Scene& scene, const BondEdit& bond);

}  // namespace seam
