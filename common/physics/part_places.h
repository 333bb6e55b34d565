#pragma once
/// Where every part of a world is, and what it belongs to: parts of one body from the pose of their
/// root.

#include <functional>

#include "common/physics/world.h"
#include "common/topology/edit.h"

namespace seam {

/// Pose of a part, and the velocity of its body's centre of mass; false when it is gone.
bool ReadPart(const World& world, PartId part, BodyState* state);

/// The same, where the state of a moving body is what `read` says.
bool ReadPart(const World& world, PartId part, const std::function<BodyState(int body)>& read,
              BodyState* state);

/// The same. Requires a part that has not left.
BodyState PartPose(const World& world, PartId part);

/// The mechanism of a part; -1 when it is anchored or gone.
int MechanismOf(const World& world, PartId part);

/// The bond that makes b rigid with a where it is now, up to `strength` N (0: for ever). Requires
/// parts that have not left.
BondEdit BondAsTheyAre(const World& world, PartId a, PartId b, float strength);

}  // namespace seam
