#pragma once
/// Finds the pose, body and mechanism of a part. The parts of a body are placed by the pose of its
/// root.

#include <functional>

#include "common/physics/world.h"
#include "common/topology/edit.h"

namespace seam {

/// Reads the pose of a part and the velocity of its body's centre of mass. False if the part is
/// gone.
bool ReadPart(const World& world, PartId part, BodyState* state);

/// Like ReadPart above, with the states of moving bodies taken from `read`.
bool ReadPart(const World& world, PartId part, const std::function<BodyState(int body)>& read,
              BodyState* state);

/// Returns the same state. Requires a part that is not gone.
BodyState PartPose(const World& world, PartId part);

/// Returns the mechanism of a part; -1 if it is anchored or gone.
int MechanismOf(const World& world, PartId part);

/// Returns the bond that makes b rigid with a in their current poses, up to `strength` N (0: for
/// ever). Requires parts that are not gone.
BondEdit BondAsTheyAre(const World& world, PartId a, PartId b, float strength);

}  // namespace seam
