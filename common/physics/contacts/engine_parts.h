#pragma once
/// Parts of the engine's own step, for a world in which it has no island to solve.

#include <box2d/box2d.h>

namespace seam {

/// Does what b2ContactManager::FindNewContacts does, with the same result, but does not look
/// through all contacts of a body that has very many of them, such as a moving room.
void FindNewPairs(b2World* world);

/// Moves a kinematic body by its velocity for h s, as the engine does. It falls asleep where it has
/// been at rest for long enough.
void MoveKinematic(b2World* world, b2Body* body, float h);

}  // namespace seam
