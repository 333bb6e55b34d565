#pragma once
/// What a player drives: the mechanisms that the player's inputs move directly.

#include <vector>

#include "common/physics/world.h"

namespace seam {

/// By mechanism of the world's composition: whether it is the player's own (its owner, or the
/// player's vehicle), whether the player's axes turn a motor, a thrust or a character of it, or of
/// a seat in which the player sits; with `actions` also whether a button pushes a part of it.
std::vector<bool> DrivenMechanisms(const World& world, int player, bool actions);

}  // namespace seam
