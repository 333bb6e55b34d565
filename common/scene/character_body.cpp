#include "common/scene/character_body.h"

#include "common/base/geometry.h"
#include "common/scene/character.h"

namespace seam {
namespace {

struct PartMeasure {
  const char* name;
  float x, y;           ///< m; of its middle, facing right, above the soles
  float width, height;  ///< m; width 0: a circle of this diameter
};

/// For 1.8 m. In this order: CharacterPart.
constexpr PartMeasure kParts[kCharacterParts] = {
    {"head", 0, 1.67f, 0, 0.25f},
    {"torso", 0, 1.24f, 0.28f, 0.60f},
    {"upper-arm-l", 0, 1.31f, 0.10f, 0.32f},
    {"lower-arm-l", 0, 0.99f, 0.09f, 0.34f},
    {"upper-arm-r", 0, 1.31f, 0.10f, 0.32f},
    {"lower-arm-r", 0, 0.99f, 0.09f, 0.34f},
    {"upper-leg-l", 0, 0.74f, 0.15f, 0.46f},
    {"lower-leg-l", 0, 0.30f, 0.12f, 0.44f},
    {"foot-l", 0.05f, 0.045f, 0.30f, 0.09f},
    {"upper-leg-r", 0, 0.74f, 0.15f, 0.46f},
    {"lower-leg-r", 0, 0.30f, 0.12f, 0.44f},
    {"foot-r", 0.05f, 0.045f, 0.30f, 0.09f},
};

struct HingeMeasure {
  const char* name;
  CharacterPart a, b;
  float y;             ///< m above the soles
  float lower, upper;  ///< rad from upright, facing right; equal: it turns freely
  /// Bound of torque as a share of weight x height (m x 10 m/s^2 x height): a man of 75 kg and
  /// 1.8 m does about 0.1 to 0.2 of it (150 to 250 N m) at ankle, knee and hip.
  float share;
};

/// In this order: CharacterJoint. Counter-clockwise is forward for what hangs (thigh, arm).
constexpr HingeMeasure kHinges[kCharacterJoints] = {
    {"neck", kTorso, kHead, 1.54f, -0.6f, 0.6f, 0.03f},
    {"shoulder-l", kTorso, kUpperArmLeft, 1.46f, 0, 0, 0.08f},
    {"elbow-l", kUpperArmLeft, kLowerArmLeft, 1.16f, 0, 2.5f, 0.06f},
    {"shoulder-r", kTorso, kUpperArmRight, 1.46f, 0, 0, 0.08f},
    {"elbow-r", kUpperArmRight, kLowerArmRight, 1.16f, 0, 2.5f, 0.06f},
    {"hip-l", kTorso, kUpperLegLeft, 0.96f, -0.7f, 2.4f, 0.20f},
    {"knee-l", kUpperLegLeft, kLowerLegLeft, 0.52f, -2.6f, 0, 0.20f},
    {"ankle-l", kLowerLegLeft, kFootLeft, 0.09f, -0.9f, 0.9f, 0.12f},
    {"hip-r", kTorso, kUpperLegRight, 0.96f, -0.7f, 2.4f, 0.20f},
    {"knee-r", kUpperLegRight, kLowerLegRight, 0.52f, -2.6f, 0, 0.20f},
    {"ankle-r", kLowerLegRight, kFootRight, 0.09f, -0.9f, 0.9f, 0.12f},
};

constexpr float kHeight = 1.8f;  ///< m; of the tables above
constexpr float kGravity = 10;   ///< m/s^2; of the bounds of torque, in every scene

/// From the body's frame, facing right and 1.8 m, to the world.
Vec2 ToWorld(const CharacterDraft& draft, float x, float y) {
  const float scale = draft.character.height / kHeight;
  const Vec2 local(draft.character.facing * scale * x, scale * y);
  return draft.position + Turned(local, draft.angle);
}

}  // namespace

const char* NameOf(CharacterPart part) { return kParts[part].name; }
const char* NameOf(CharacterJoint joint) { return kHinges[joint].name; }

std::vector<Part> CharacterParts(const CharacterDraft& draft) {
  const float scale = draft.character.height / kHeight;
  std::vector<Part> parts;
  for (const PartMeasure& m : kParts) {
    Part part;
    part.name = draft.character.name + "." + m.name;
    part.kind = m.width > 0 ? ShapeKind::kBox : ShapeKind::kCircle;
    part.size = scale * Vec2(m.width, m.height);
    part.radius = scale * m.height / 2;
    part.position = ToWorld(draft, m.x, m.y);
    part.angle = draft.angle;
    part.material.density = draft.density;
    part.material.friction = draft.friction;
    part.group = draft.group;
    part.velocity = draft.velocity;
    part.owner = draft.owner;
    part.line = draft.character.line;
    parts.push_back(part);
  }
  return parts;
}

std::vector<Joint> CharacterHinges(const CharacterDraft& draft, float mass) {
  const Character& character = draft.character;
  std::vector<Joint> joints;
  for (int j = 0; j < kCharacterJoints; ++j) {
    const HingeMeasure& m = kHinges[j];
    Joint joint;
    joint.name = character.name + "." + m.name;
    joint.kind = JointKind::kRevolute;
    joint.a = character.parts[m.a];
    joint.b = character.parts[m.b];
    joint.anchor_a = joint.anchor_b = ToWorld(draft, 0, m.y);
    joint.limited = m.lower < m.upper;
    joint.lower = character.facing > 0 ? m.lower : -m.upper;
    joint.upper = character.facing > 0 ? m.upper : -m.lower;
    const float stated = draft.torque[static_cast<std::size_t>(j)];
    const float usual = m.share * mass * kGravity * character.height;
    joint.motor_torque = draft.strength * (stated > 0 ? stated : usual);
    if (!character.active) joint.motor_torque *= kCharacterSlack;
    joint.line = character.line;
    joints.push_back(joint);
  }
  return joints;
}

std::vector<int> JointsOf(const Scene& scene, int character) {
  const Character& c = scene.characters[static_cast<std::size_t>(character)];
  return std::vector<int>(c.joints.begin(), c.joints.end());
}

}  // namespace seam
