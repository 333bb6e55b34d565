#include "common/scene/character_body.h"

#include "common/base/geometry.h"
#include "common/scene/character.h"
#include "common/scene/mass.h"

namespace seam {
namespace {

constexpr int kCorners = 8;  ///< the engine's limit for one shape

/// Profile of a body part, m: about the part's middle, facing right, counter-clockwise.
struct PartOutline {
  float x[kCorners], y[kCorners];
};

/// Returns a limb along y, with radii `top` and `bottom`, m, thick at its muscles.
constexpr PartOutline Limb(float length, float top, float bottom) {
  const float up = length / 2, down = -length / 2;
  return {{-0.5f * bottom, 0.5f * bottom, bottom, top, 0.5f * top, -0.5f * top, -top, -bottom},
          {down, down, down + 0.8f * bottom, up - 0.8f * top, up, up, up - 0.8f * top,
           down + 0.8f * bottom}};
}

/// Chin forward, back of the skull round.
constexpr PartOutline kHeadOutline = {
    {-0.03f, 0.07f, 0.105f, 0.10f, 0.04f, -0.05f, -0.11f, -0.10f},
    {-0.13f, -0.125f, -0.03f, 0.06f, 0.13f, 0.13f, 0.06f, -0.05f}};
/// Pelvis at the bottom, chest at the top.
constexpr PartOutline kTorsoOutline = {
    {-0.09f, 0.08f, 0.135f, 0.155f, 0.08f, -0.08f, -0.145f, -0.14f},
    {-0.30f, -0.30f, -0.20f, 0.12f, 0.30f, 0.30f, 0.14f, -0.20f}};
constexpr PartOutline kUpperArm = Limb(0.32f, 0.058f, 0.045f);
constexpr PartOutline kLowerArm = Limb(0.34f, 0.048f, 0.036f);
constexpr PartOutline kUpperLeg = Limb(0.46f, 0.090f, 0.062f);
constexpr PartOutline kLowerLeg = Limb(0.44f, 0.066f, 0.042f);
/// A flat sole from heel to toe; the instep rises to the ankle.
constexpr PartOutline kFoot = {{-0.15f, 0.15f, 0.15f, 0.11f, 0.02f, -0.05f, -0.10f, -0.15f},
                               {-0.045f, -0.045f, -0.02f, 0.002f, 0.038f, 0.045f, 0.040f, -0.005f}};

struct PartMeasure {
  const char* name;
  float x, y;  ///< m; its middle, facing right, above the soles
  const PartOutline& outline;
};

/// For the height 1.8 m, in the order of CharacterPart.
constexpr PartMeasure kParts[kCharacterParts] = {
    {"head", 0, 1.67f, kHeadOutline},     {"torso", 0, 1.24f, kTorsoOutline},
    {"upper-arm-l", 0, 1.31f, kUpperArm}, {"lower-arm-l", 0, 0.99f, kLowerArm},
    {"upper-arm-r", 0, 1.31f, kUpperArm}, {"lower-arm-r", 0, 0.99f, kLowerArm},
    {"upper-leg-l", 0, 0.74f, kUpperLeg}, {"lower-leg-l", 0, 0.30f, kLowerLeg},
    {"foot-l", 0.05f, 0.045f, kFoot},     {"upper-leg-r", 0, 0.74f, kUpperLeg},
    {"lower-leg-r", 0, 0.30f, kLowerLeg}, {"foot-r", 0.05f, 0.045f, kFoot},
};

struct HingeMeasure {
  const char* name;
  CharacterPart a, b;
  float y;             ///< m above the soles
  float lower, upper;  ///< rad from upright, facing right; equal: unlimited
  /// Torque limit as a share of weight x height (m x 10 m/s^2 x height): a man of 75 kg and 1.8 m
  /// reaches about 0.1 to 0.2 of that (150 to 250 N m) at ankle, knee and hip.
  float share;
};

/// In the order of CharacterJoint. Counter-clockwise is forward for hanging limbs (thigh, arm).
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

constexpr float kHeight = 1.8f;  ///< m; height for which the tables above hold
constexpr float kGravity = 10;   ///< m/s^2; used for torque limits in every scene

/// Transforms from the body's frame (facing right, 1.8 m) to the world.
Vec2 ToWorld(const CharacterDraft& draft, float x, float y) {
  const float scale = draft.character.height / kHeight;
  const Vec2 local(draft.character.facing * scale * x, scale * y);
  return draft.position + Turned(local, draft.angle);
}

/// Returns the outline's corners in the part's frame, counter-clockwise even if mirrored.
std::vector<Vec2> Corners(const PartOutline& outline, float facing, float scale) {
  std::vector<Vec2> corners;
  for (int i = 0; i < kCorners; ++i) {
    const int at = facing > 0 ? i : kCorners - 1 - i;
    corners.emplace_back(facing * scale * outline.x[at], scale * outline.y[at]);
  }
  return corners;
}

/// Shifts the part's origin to its centre of mass, as a box has it.
void MoveToCentre(Part* part) {
  const Vec2 centre = PartProperties(*part).centre.cast<float>();
  for (Vec2& p : part->points) p -= centre;
  part->position += Turned(centre, part->angle);
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
    part.kind = ShapeKind::kPolygon;
    part.points = Corners(m.outline, draft.character.facing, scale);
    part.position = ToWorld(draft, m.x, m.y);
    part.angle = draft.angle;
    part.material.density = draft.density;
    MoveToCentre(&part);
    part.material.friction = draft.friction;
    part.filter.group = draft.group;
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
