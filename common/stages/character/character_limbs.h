#pragma once
/// A character's bodies and hinges in the engine: what it senses of them, and how its motors work.
///
/// Everything here is in the character's own frame: x points where it faces, y up, and angles turn
/// from x to y, so that one that faces left is a mirror image. Nothing but the hinges' motors is
/// ever driven, each within its bound: what moves a character is torque in joints and contact.

#include <box2d/box2d.h>

#include "common/physics/stage.h"
#include "common/scene/character.h"

namespace seam {

struct LegSense {
  b2Vec2 hip{0, 0}, knee{0, 0}, ankle{0, 0};  ///< m
  float thigh = 0, shank = 0, foot = 0;       ///< rad, absolute; 0 hangs straight down or lies flat
  bool down = false;                          ///< the foot touches something
  b2Vec2 ground_velocity{0, 0};               ///< m/s, of what it touches
};

struct CharacterSense {
  float mass = 0;                       ///< kg
  b2Vec2 centre{0, 0}, velocity{0, 0};  ///< of mass, m and m/s
  float turning = 0;                    ///< N m s, angular momentum about the centre of mass
  b2Vec2 hip{0, 0}, hip_velocity{0, 0};
  float torso = 0, torso_spin = 0;  ///< rad and rad/s; 0 is upright, positive leans back
  LegSense legs[2];
  bool lying = false;  ///< the torso or head touches something
};

/// A point of the ground.
struct GroundPoint {
  bool found = false;
  b2Vec2 point{0, 0};
  b2Vec2 normal{0, 1};
};

class CharacterLimbs {
 public:
  CharacterLimbs(const Character& character, const StageWorld& world);

  /// Looks the bodies and joints up.
  void Find(b2World* world);
  void Forget();

  /// Torso and both legs with all their hinges: what a balance needs.
  bool whole() const { return whole_; }
  bool dynamic() const;  ///< the torso is; else nothing here can move it
  bool awake() const;
  /// Requires whole().
  CharacterSense Sense() const;

  /// m in the shape of 1.8 m times this are m here.
  float scale() const { return scale_; }
  const CharacterShape& shape() const { return shape_; }  ///< to scale
  bool has(CharacterJoint joint) const { return joints_[joint] != nullptr; }
  float angle(CharacterJoint joint) const;                           ///< rad
  float bound(CharacterJoint joint) const { return bound_[joint]; }  ///< N m

  /// A servo: torque stiffness (angle - now) + damping (spin - now), N m, within the bound, never
  /// driving the joint faster than it would by itself (the spin at which that torque is 0): so it
  /// is stable at any stiffness and step, as in Tan, Liu and Turk, "Stable Proportional-Derivative
  /// Controllers", 2011. A joint without limits goes the shorter way round.
  void Servo(CharacterJoint joint, float angle, float spin, float stiffness, float damping);
  /// Torque on the outer part, within the bound; returns what it is.
  float Torque(CharacterJoint joint, float torque);
  /// Only muscle tone, this share of it.
  void Slacken(CharacterJoint joint, float tone);
  void SlackenAll(float tone = 1);
  /// What the motor was last told, N m on the outer part.
  float told(CharacterJoint joint) const { return told_[joint]; }

  /// The highest ground below `from`, not deeper than `depth` m; nothing of the character itself.
  GroundPoint GroundBelow(b2Vec2 from, float depth) const {
    return Hit(from, from - b2Vec2(0, depth));
  }
  /// What the way from one point to another meets first; nothing of the character itself.
  GroundPoint Hit(b2Vec2 from, b2Vec2 to) const;
  /// Where a joint is, m, in the own frame. Requires has(joint).
  b2Vec2 At(CharacterJoint joint) const { return Own(joints_[joint]->GetAnchorA()); }
  b2Body* body(CharacterPart part) const { return bodies_[part]; }
  b2Vec2 Own(b2Vec2 world) const { return b2Vec2(facing_ * world.x, world.y); }

 private:
  void SenseLeg(int side, LegSense* leg) const;
  bool Touches(CharacterPart part, float up_min, b2Vec2* velocity) const;

  const Character character_;  // a copy: edits of the scene may move it
  const StageWorld world_;
  float facing_ = 1, scale_ = 1;
  CharacterShape shape_;
  b2World* engine_ = nullptr;
  b2Body* bodies_[kCharacterParts] = {};
  b2RevoluteJoint* joints_[kCharacterJoints] = {};
  float bound_[kCharacterJoints] = {};
  float told_[kCharacterJoints] = {};
  bool whole_ = false;
};

/// The joints and parts of a side, 0 left or 1 right.
inline CharacterJoint Hip(int side) { return side == 0 ? kHipLeft : kHipRight; }
inline CharacterJoint Knee(int side) { return side == 0 ? kKneeLeft : kKneeRight; }
inline CharacterJoint Ankle(int side) { return side == 0 ? kAnkleLeft : kAnkleRight; }
inline CharacterJoint Shoulder(int side) { return side == 0 ? kShoulderLeft : kShoulderRight; }
inline CharacterJoint Elbow(int side) { return side == 0 ? kElbowLeft : kElbowRight; }

}  // namespace seam
