#include "common/topology/grip.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/scene/assembly.h"
#include "common/scene/character.h"

namespace seam {

int CharacterOfHand(const Scene& scene, PartId part) {
  for (std::size_t c = 0; c < scene.characters.size(); ++c) {
    const auto& parts = scene.characters[c].parts;
    if (part == parts[kLowerArmLeft] || part == parts[kLowerArmRight]) return static_cast<int>(c);
  }
  return -1;
}

std::optional<Vec2> FingertipOf(const Scene& scene, PartId hand) {
  const int index = CharacterOfHand(scene, hand);
  if (index < 0) return std::nullopt;
  const Character& character = scene.characters[static_cast<std::size_t>(index)];
  const bool left = hand == character.parts[kLowerArmLeft];
  const auto elbow = static_cast<std::size_t>(character.joints[left ? kElbowLeft : kElbowRight]);
  const Joint& joint = scene.joints[elbow];
  const Part& part = scene.parts[static_cast<std::size_t>(hand)];
  if (joint.gone || part.gone) return std::nullopt;
  return Turned(Vec2(part.position - joint.anchor_b), -part.angle);
}

float GripStrength(const Scene& scene, int character) {
  float mass = 0;
  for (const PartId part : scene.characters[static_cast<std::size_t>(character)].parts) {
    mass += PartMass(scene.parts[static_cast<std::size_t>(part)]);
  }
  return mass * std::max(1.0f, scene.gravity.norm());
}

bool MayGrip(const Scene& scene, const BondEdit& bond) {
  if (bond.cause != BondCause::kGrip || bond.angle != 0) return false;
  const int index = CharacterOfHand(scene, bond.b);
  if (index < 0 || !FingertipOf(scene, bond.b)) return false;
  const Character& character = scene.characters[static_cast<std::size_t>(index)];
  const auto& own = character.parts;
  if (!character.grip || std::count(own.begin(), own.end(), bond.a) != 0) return false;
  const bool holds = std::any_of(scene.joints.begin(), scene.joints.end(), [&](const Joint& j) {
    return !j.gone && IsGrip(j) && j.b == bond.b;
  });
  return !holds && bond.strength == GripStrength(scene, index);
}

}  // namespace seam
