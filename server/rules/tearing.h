#pragma once
/// Joints of a character that are torn when it dies.

#include <functional>
#include <vector>

#include "common/physics/world.h"
#include "common/scene/character.h"
#include "common/topology/edit.h"
#include "server/rules/rule_source.h"

namespace seam {

/// Everything that struck bodies in one tick.
struct Violence {
  std::vector<Blow> blows;
  std::vector<BlastEdit> blasts;
};

/// Returns the existing joints that are overloaded, ascending: of each part whose velocity a blow
/// changed by more than Character::tears_above the one nearest to the blow's point, and each joint
/// between two parts whose velocities the blasts change by more against each other. A part that
/// shows w m across the ray receives impulse (1 - r/radius) w / mass, unless something anchored
/// lies between. `read`: states of the bodies.
std::vector<int> OverloadedJoints(const World& world, const Character& character,
                                  const Violence& violence,
                                  const std::function<BodyState(int body)>& read);

}  // namespace seam
