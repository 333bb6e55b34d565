#pragma once
/// Builds a character's parts and hinges, upright at tick 0 or turned by an angle.

#include <string>
#include <vector>

#include "common/scene/character.h"
#include "common/scene/scene.h"

namespace seam {

/// A [[character]] as read.
struct CharacterDraft {
  Character character;
  Vec2 position{0, 0};  ///< m; position of the soles, below the hips
  float angle = 0;      ///< rad, rotation of the whole body about `position`
  float density = 1;    ///< kg/m^2
  float friction = 0.8f;
  float strength = 1;                            ///< factor on all torque limits
  std::array<float, kCharacterJoints> torque{};  ///< N m; if positive, replaces the default
  Vec2 velocity{0, 0};                           ///< m/s
  int owner = -1;
  int group = 0;  ///< negative, so that the character's parts do not collide
};

/// Muscle tone of a limp or passive character as a share of its joints' torque limits.
constexpr float kCharacterSlack = 0.03f;

/// Returns "head", "torso", "upper-arm-l", ...
const char* NameOf(CharacterPart part);
/// Returns "neck", "shoulder-l", ...
const char* NameOf(CharacterJoint joint);

/// Returns the parts, without ids, in the order of CharacterPart.
std::vector<Part> CharacterParts(const CharacterDraft& draft);

/// Returns the hinges between the parts `draft.character.parts`, in the order of CharacterJoint,
/// each with its torque limit as a motor's. `mass`: of the whole body, kg.
std::vector<Joint> CharacterHinges(const CharacterDraft& draft, float mass);

}  // namespace seam
