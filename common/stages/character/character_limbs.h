#pragma once
/// A character's bodies and hinges in the engine: its senses and its motors.
///
/// All values are in the character's own frame: x points forward, y up, and angles turn from x to
/// y, so that a character facing left is a mirror image. Only the hinges' motors are driven, each
/// within its limit: a character moves by joint torques and contacts alone.

#include <box2d/box2d.h>

#include "common/physics/stage.h"
#include "common/scene/character.h"

namespace seam {

struct LegSense {
  b2Vec2 hip{0, 0}, knee{0, 0}, ankle{0, 0};  ///< m
  float thigh = 0, shank = 0, foot = 0;       ///< rad, absolute; 0: straight down, or flat
  bool down = false;                          ///< the foot touches something
  b2Vec2 ground_velocity{0, 0};               ///< m/s, of the touched body
};

struct CharacterSense {
  float mass = 0;                       ///< kg
  b2Vec2 centre{0, 0}, velocity{0, 0};  ///< of the centre of mass, m and m/s
  float turning = 0;                    ///< N m s, angular momentum about the centre of mass
  b2Vec2 hip{0, 0}, hip_velocity{0, 0};
  float torso = 0, torso_spin = 0;  ///< rad and rad/s; 0 is upright, positive leans back
  LegSense legs[2];
  bool lying = false;  ///< the torso or head touches something
};

/// A point on the ground.
struct GroundPoint {
  bool found = false;
  b2Vec2 point{0, 0};
  b2Vec2 normal{0, 1};
};

class CharacterLimbs {
 public:
  CharacterLimbs(const Character& character, const StageWorld& world);

  /// Looks up the bodies and joints.
  void Find(b2World* world);
  void Forget();

  /// True if the torso and both legs are present with all their hinges, as balance needs.
  bool whole() const { return whole_; }
  bool dynamic() const;  ///< true if the torso is dynamic; otherwise motors move nothing
  bool awake() const;
  /// Requires whole().
  CharacterSense Sense() const;

  /// Factor from lengths of the 1.8 m shape to this character's.
  float scale() const { return scale_; }
  const CharacterShape& shape() const { return shape_; }  ///< scaled
  bool has(CharacterJoint joint) const { return joints_[joint] != nullptr; }
  float angle(CharacterJoint joint) const;                           ///< rad
  float bound(CharacterJoint joint) const { return bound_[joint]; }  ///< N m

  /// Drives a joint as a servo: torque stiffness (angle - now) + damping (spin - now), N m, within
  /// the limit. Never drives the joint faster than the spin at which that torque is 0, so it is
  /// stable at any stiffness and step, as in Tan, Liu and Turk, "Stable Proportional-Derivative
  /// Controllers", 2011. A joint without limits turns the shorter way.
  void Servo(CharacterJoint joint, float angle, float spin, float stiffness, float damping);
  /// Applies a torque to the outer part, within the limit; returns the torque applied.
  float Torque(CharacterJoint joint, float torque);
  /// Leaves only this share of the muscle tone.
  void Slacken(CharacterJoint joint, float tone);
  void SlackenAll(float tone = 1);
  /// Motor torque as last commanded, N m on the outer part.
  float told(CharacterJoint joint) const { return told_[joint]; }

  /// Returns the highest ground below `from` within `depth` m, ignoring the character itself.
  GroundPoint GroundBelow(b2Vec2 from, float depth) const {
    return Hit(from, from - b2Vec2(0, depth));
  }
  /// Returns the first hit of a ray between two points, ignoring the character itself.
  GroundPoint Hit(b2Vec2 from, b2Vec2 to) const;
  /// Returns a joint's position, m, in the own frame. Requires has(joint).
  b2Vec2 At(CharacterJoint joint) const { return Own(joints_[joint]->GetAnchorA()); }
  b2Body* body(CharacterPart part) const { return bodies_[part]; }
  b2Vec2 Own(b2Vec2 world) const { return b2Vec2(facing_ * world.x, world.y); }

 private:
  void SenseLeg(int side, LegSense* leg) const;
  bool Touches(CharacterPart part, float up_min, b2Vec2* velocity) const;

  const Character character_;  // a copy: edits may move the scene's
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

/// Return the joints of a side, 0 left or 1 right.
inline CharacterJoint Hip(int side) { return side == 0 ? kHipLeft : kHipRight; }
inline CharacterJoint Knee(int side) { return side == 0 ? kKneeLeft : kKneeRight; }
inline CharacterJoint Ankle(int side) { return side == 0 ? kAnkleLeft : kAnkleRight; }
inline CharacterJoint Shoulder(int side) { return side == 0 ? kShoulderLeft : kShoulderRight; }
inline CharacterJoint Elbow(int side) { return side == 0 ? kElbowLeft : kElbowRight; }

}  // namespace seam
