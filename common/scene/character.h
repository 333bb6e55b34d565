#pragma once
/// A character: a `[[character]]` of a scene expands into twelve parts and eleven limited hinges,
/// ordinary parts and joints of one mechanism.
///
///        (o)      head            neck
///        |#|      torso           shoulders, hips
///       / # \     upper arms      elbows
///      |  #  |    lower arms
///        | |      upper legs      knees
///        | |      lower legs      ankles
///        |_|_     feet            (facing right: the toes are on the right)
///
/// Each part is one convex outline of eight corners, tapered like a real limb; soles are flat.

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "common/scene/types.h"

namespace seam {

/// Indices into Character::parts. Left and right look the same in two dimensions; right follows
/// left.
enum CharacterPart {
  kHead,
  kTorso,
  kUpperArmLeft,
  kLowerArmLeft,
  kUpperArmRight,
  kLowerArmRight,
  kUpperLegLeft,
  kLowerLegLeft,
  kFootLeft,
  kUpperLegRight,
  kLowerLegRight,
  kFootRight,
  kCharacterParts
};

/// Indices into Character::joints.
enum CharacterJoint {
  kNeck,
  kShoulderLeft,
  kElbowLeft,
  kShoulderRight,
  kElbowRight,
  kHipLeft,
  kKneeLeft,
  kAnkleLeft,
  kHipRight,
  kKneeRight,
  kAnkleRight,
  kCharacterJoints
};

/// True for arms and legs.
constexpr bool IsLimb(int part) { return part >= kUpperArmLeft; }
/// Requires IsLimb(part).
constexpr bool IsLeft(int part) {
  return part <= kLowerArmLeft || (part >= kUpperLegLeft && part <= kFootLeft);
}

struct CharacterGains;  // common/stages/character/character_gains.h

struct Character {
  std::string name;     ///< its parts are "name.head" etc., its joints "name.neck" etc.
  bool active = false;  ///< its joints have motors, which a controller drives
  int player = -1;      ///< its axes drive the character; -1: it only stands
  float facing = 1;     ///< 1: toes to the right, -1: to the left
  float height = 1.8f;  ///< m
  std::array<PartId, kCharacterParts> parts{};
  std::array<int, kCharacterJoints> joints{};  ///< indices into Scene::joints
  /// N m by which each joint resists turning while not driven: muscle tone of a limp, passive or
  /// dead body.
  std::array<float, kCharacterJoints> slack{};
  /// Gains of its controller, for optimisation; nullptr: the built-in ones. Not part of a scene
  /// file: a peer always uses the built-in ones.
  std::shared_ptr<const CharacterGains> gains;
  /// m/s: when it dies, a blow that changes the velocity of a part by more tears a joint.
  float tears_above = 5;
  bool grip = false;  ///< its hands may grip parts (common/topology/grip.h)
  int line = 0;       ///< line in the scene file
};

struct Scene;

/// Measures of a body, m, for the height 1.8 m; they scale with the height. Heights are above the
/// soles, standing straight.
struct CharacterShape {
  float hip = 0.96f, shoulder = 1.46f, neck = 1.54f;
  float thigh = 0.44f, shank = 0.43f;          ///< hip to knee, knee to ankle
  float ankle = 0.09f;                         ///< above the sole
  float heel = 0.10f, toe = 0.20f;             ///< behind and before the ankle
  float upper_arm = 0.30f, lower_arm = 0.34f;  ///< shoulder to elbow, elbow to fingertips
};

/// Returns a character's joints, to be broken when it dies: indices into Scene::joints.
std::vector<int> JointsOf(const Scene& scene, int character);

}  // namespace seam
