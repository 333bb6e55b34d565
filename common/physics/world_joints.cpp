#include "common/physics/world_joints.h"

#include "common/base/check.h"
#include "common/physics/world_build.h"
#include "common/physics/world_couplings.h"
#include "common/scene/joint_kinds.h"

namespace seam {
namespace {

/// Sets the fields that revolute, wheel and prismatic joints share.
template <typename Def>
void SetCommon(const Joint& joint, Def* def) {
  def->enableMotor = joint.motor_torque > 0;
  def->collideConnected = joint.collide;
}

/// Sets B's end, which may lie apart from A's after bonds have moved an end.
template <typename Def>
void SetEnds(const Joint& joint, b2Body* b, Def* def) {
  def->localAnchorB = b->GetLocalPoint(ToB2(joint.anchor_b));
}

b2Joint* AddRevolute(const Joint& joint, b2Body* a, b2Body* b, b2World* world) {
  b2RevoluteJointDef def;
  def.Initialize(a, b, ToB2(joint.anchor_a));
  SetEnds(joint, b, &def);
  def.referenceAngle -= joint.turn;
  SetCommon(joint, &def);
  def.enableLimit = joint.limited;
  def.lowerAngle = joint.lower;
  def.upperAngle = joint.upper;
  def.maxMotorTorque = joint.motor_torque;
  return world->CreateJoint(&def);
}

b2Joint* AddPrismatic(const Joint& joint, b2Body* a, b2Body* b, b2World* world) {
  b2PrismaticJointDef def;
  def.Initialize(a, b, ToB2(joint.anchor_a), ToB2(joint.axis));
  SetEnds(joint, b, &def);
  def.referenceAngle -= joint.turn;
  SetCommon(joint, &def);
  def.enableLimit = joint.limited;
  def.lowerTranslation = joint.lower;
  def.upperTranslation = joint.upper;
  def.maxMotorForce = joint.motor_torque;
  return world->CreateJoint(&def);
}

b2Joint* AddWheel(const Joint& joint, b2Body* a, b2Body* b, b2World* world) {
  b2WheelJointDef def;
  def.Initialize(a, b, ToB2(joint.anchor_a), ToB2(joint.axis));
  SetEnds(joint, b, &def);
  SetCommon(joint, &def);
  if (joint.frequency_hz > 0) {
    b2LinearStiffness(def.stiffness, def.damping, joint.frequency_hz, joint.damping_ratio, a, b);
  }
  // Without a spring Box2D would let the wheel slide freely along the axis: fix it, or use the
  // scene's limits.
  def.enableLimit = joint.limited || joint.frequency_hz <= 0;
  def.lowerTranslation = joint.limited ? joint.lower : 0;
  def.upperTranslation = joint.limited ? joint.upper : 0;
  def.maxMotorTorque = joint.motor_torque;
  return world->CreateJoint(&def);
}

/// A length beyond any limit, m. Not FLT_MAX: the engine divides the remaining length by a step's
/// seconds and multiplies by the mass, which is zero between two bodies that are not simulated, and
/// 0 times infinity is NaN.
constexpr float kNoLimit = 1e30f;

b2Joint* AddDistance(const Joint& joint, b2Body* a, b2Body* b, b2World* world) {
  b2DistanceJointDef def;
  def.Initialize(a, b, ToB2(joint.anchor_a), ToB2(joint.anchor_b));
  if (joint.length > 0) def.length = joint.length;
  def.minLength = def.maxLength = def.length;
  if (joint.kind == JointKind::kRope) def.minLength = 0;
  if (joint.frequency_hz > 0) {
    // Box2D's spring works only between unequal limits.
    b2LinearStiffness(def.stiffness, def.damping, joint.frequency_hz, joint.damping_ratio, a, b);
    def.minLength = 0;
    def.maxLength = kNoLimit;
  }
  if (joint.limited) {
    def.minLength = joint.lower;
    def.maxLength = joint.upper;
  }
  def.collideConnected = joint.collide;
  return world->CreateJoint(&def);
}

b2Joint* AddWeld(const Joint& joint, b2Body* a, b2Body* b, b2World* world) {
  b2WeldJointDef def;
  def.Initialize(a, b, ToB2(joint.anchor_a));
  SetEnds(joint, b, &def);
  def.referenceAngle -= joint.turn;
  if (joint.frequency_hz > 0) {
    b2AngularStiffness(def.stiffness, def.damping, joint.frequency_hz, joint.damping_ratio, a, b);
  }
  def.collideConnected = joint.collide;
  return world->CreateJoint(&def);
}

b2Joint* AddPoseMotor(const Joint& joint, b2Body* a, b2Body* b, b2World* world) {
  b2MotorJointDef def;
  def.Initialize(a, b);
  // Offset of b's origin in a's frame when the ends meet at the rest angle.
  def.angularOffset -= joint.turn;
  def.linearOffset = a->GetLocalPoint(ToB2(joint.anchor_a)) -
                     b2Mul(b2Rot(def.angularOffset), b->GetLocalPoint(ToB2(joint.anchor_b)));
  def.maxForce = joint.force_max;
  def.maxTorque = joint.torque_max;
  def.collideConnected = joint.collide;
  return world->CreateJoint(&def);
}

}  // namespace

b2Joint* MakeJoint(const Joint& joint, b2Body* a, b2Body* b, b2World* world) {
  switch (joint.kind) {
    case JointKind::kWeld:
    case JointKind::kGlue: return AddWeld(joint, a, b, world);
    case JointKind::kRevolute: return AddRevolute(joint, a, b, world);
    case JointKind::kWheel: return AddWheel(joint, a, b, world);
    case JointKind::kDistance:
    case JointKind::kRope: return AddDistance(joint, a, b, world);
    case JointKind::kPrismatic: return AddPrismatic(joint, a, b, world);
    case JointKind::kMotor: return AddPoseMotor(joint, a, b, world);
    case JointKind::kPulley: return MakePulley(joint, a, b, world);
    case JointKind::kGear:  // MakeGear
    case JointKind::kKinematic: break;
  }
  SEAM_ASSERT(false);
  return nullptr;
}

bool HasMotor(const Joint& joint) {
  return joint.motor_torque > 0 ||
         (HoldOf(joint.kind) == JointHold::kPose && joint.motor_player >= 0);
}

Motor MotorOf(const Joint& joint, b2Joint* made, int index) {
  Motor motor;
  motor.index = index;
  motor.joint = made;
  motor.player = joint.motor_player;
  motor.axis = joint.motor_axis;
  motor.speed = joint.motor_speed;
  if (HoldOf(joint.kind) != JointHold::kPose) return motor;
  const auto& pose = *static_cast<b2MotorJoint*>(made);
  motor.speed = 1;
  motor.offset = pose.GetLinearOffset();
  motor.reach = ToB2(joint.reach);
  motor.angle = pose.GetAngularOffset();
  motor.swing = joint.swing;
  return motor;
}

float Motor::Speed() const {
  switch (joint->GetType()) {
    case e_revoluteJoint: return static_cast<b2RevoluteJoint*>(joint)->GetMotorSpeed();
    case e_wheelJoint: return static_cast<b2WheelJoint*>(joint)->GetMotorSpeed();
    case e_prismaticJoint: return static_cast<b2PrismaticJoint*>(joint)->GetMotorSpeed();
    default: return held;
  }
}

void Motor::SetSpeed(float now) {
  switch (joint->GetType()) {
    case e_revoluteJoint: static_cast<b2RevoluteJoint*>(joint)->SetMotorSpeed(now); break;
    case e_wheelJoint: static_cast<b2WheelJoint*>(joint)->SetMotorSpeed(now); break;
    case e_prismaticJoint: static_cast<b2PrismaticJoint*>(joint)->SetMotorSpeed(now); break;
    default: {
      auto& pose = *static_cast<b2MotorJoint*>(joint);
      held = now;
      pose.SetLinearOffset(offset + now * reach);
      pose.SetAngularOffset(angle + now * swing);
    }
  }
}

}  // namespace seam
