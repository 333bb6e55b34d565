#pragma once
/// What a character is made of: its parts and hinges, upright at tick 0 or turned by an angle.

#include <string>
#include <vector>

#include "common/scene/character.h"
#include "common/scene/scene.h"

namespace seam {

/// What [[character]] says.
struct CharacterDraft {
  Character character;
  Vec2 position{0, 0};  ///< m; of the soles, below the hips
  float angle = 0;      ///< rad, of the whole body about `position`
  float density = 1;    ///< kg/m^2
  float friction = 0.8f;
  float strength = 1;                            ///< of all bounds of torque
  std::array<float, kCharacterJoints> torque{};  ///< N m where positive: instead of the default
  Vec2 velocity{0, 0};                           ///< m/s
  int owner = -1;
  int group = 0;  ///< negative, so that its parts do not collide
};

/// Muscle tone of a limp or passive character as a share of its joints' bounds of torque.
constexpr float kCharacterSlack = 0.03f;

/// "head", "torso", "upper-arm-l", ...
const char* NameOf(CharacterPart part);
/// "neck", "shoulder-l", ...
const char* NameOf(CharacterJoint joint);

/// The parts, without ids, in the order of CharacterPart.
std::vector<Part> CharacterParts(const CharacterDraft& draft);

/// The hinges between parts with the ids in `draft.character.parts`, in the order of
/// CharacterJoint, each with its bound of torque as a motor's.
std::vector<Joint> CharacterHinges(const CharacterDraft& draft, float mass);

}  // namespace seam
