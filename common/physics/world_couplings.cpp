#include "common/physics/world_couplings.h"

#include "common/base/check.h"
#include "common/physics/joint_impulses.h"
#include "common/physics/joint_impulses.h"
#include "common/physics/reveal.h"
#include "common/physics/world_build.h"

namespace seam {
namespace {

SEAM_REVEAL(GearConstant, float, b2GearJoint, m_constant);

/// Returns the direction in which a gear pushes the second body of its joint: zero for a hinge.
b2Vec2 PushOf(b2Joint* geared) {
  if (geared->GetType() != e_prismaticJoint) return b2Vec2_zero;
  const auto& slide = *static_cast<b2PrismaticJoint*>(geared);
  return geared->GetBodyA()->GetWorldVector(slide.GetLocalAxisA());
}

// The engine's own GetReactionForce uses the directions of its last step, which are unset where it
// did not solve the joint.

JointForces ForcesOfGear(b2GearJoint* gear, float hz) {
  const float along = hz * *ImpulsesOf(gear).at[0];
  return {along * PushOf(gear->GetJoint1()), gear->GetRatio() * along * PushOf(gear->GetJoint2())};
}

JointForces ForcesOfPulley(b2PulleyJoint* pulley, float hz) {
  b2Vec2 up_a = pulley->GetGroundAnchorA() - pulley->GetAnchorA();
  b2Vec2 up_b = pulley->GetGroundAnchorB() - pulley->GetAnchorB();
  up_a.Normalize();
  up_b.Normalize();
  const float pull = hz * *ImpulsesOf(pulley).at[0];
  return {pull * up_a, pulley->GetRatio() * pull * up_b};
}

/// Returns the force, N, of impulses, N s, along and across an axis.
b2Vec2 Along(float hz, float along, float across, const b2Vec2& axis) {
  return hz * (along * axis + across * b2Cross(1.0f, axis));
}

/// Returns the force on body B. The engine's reaction would use directions that only its own solver
/// sets.
b2Vec2 ForceOnB(b2Joint* joint, float hz) {
  const JointImpulses impulses = ImpulsesOf(joint);
  const auto& p = impulses.at;
  switch (joint->GetType()) {
    case e_distanceJoint: {
      b2Vec2 way = joint->GetAnchorB() - joint->GetAnchorA();
      way.Normalize();
      return Along(hz, *p[0] + *p[1] - *p[2], 0, way);
    }
    case e_prismaticJoint: {
      const auto& slide = *static_cast<b2PrismaticJoint*>(joint);
      const b2Vec2 axis = joint->GetBodyA()->GetWorldVector(slide.GetLocalAxisA());
      return Along(hz, *p[2] + *p[3] - *p[4], *p[0], axis);
    }
    case e_wheelJoint: {
      const auto& wheel = *static_cast<b2WheelJoint*>(joint);
      const b2Vec2 axis = joint->GetBodyA()->GetWorldVector(wheel.GetLocalAxisA());
      return Along(hz, *p[2] + *p[3] - *p[4], *p[0], axis);
    }
    default: return joint->GetReactionForce(hz);
  }
}

}  // namespace

b2Joint* MakeGear(const Joint& gear, b2Joint* first, b2Joint* second, b2World* world) {
  b2GearJointDef def;
  def.bodyA = first->GetBodyB();
  def.bodyB = second->GetBodyB();
  def.joint1 = first;
  def.joint2 = second;
  def.ratio = gear.ratio;
  def.collideConnected = gear.collide;
  auto* made = static_cast<b2GearJoint*>(world->CreateJoint(&def));
  // The engine takes the current value, which is not the initial one after bonds have moved parts.
  made->*Member(GearConstant()) = 0;
  return made;
}

b2Joint* MakePulley(const Joint& pulley, b2Body* a, b2Body* b, b2World* world) {
  b2PulleyJointDef def;
  def.Initialize(a, b, ToB2(pulley.ground_a), ToB2(pulley.ground_b), ToB2(pulley.anchor_a),
                 ToB2(pulley.anchor_b), pulley.ratio);
  def.lengthA = pulley.length;  // the engine uses only their sum, weighted by the ratio
  def.lengthB = 0;
  def.collideConnected = pulley.collide;
  return world->CreateJoint(&def);
}

JointForces ForcesOf(b2Joint* joint, float hz) {
  if (joint->GetType() == e_gearJoint) return ForcesOfGear(static_cast<b2GearJoint*>(joint), hz);
  if (joint->GetType() == e_pulleyJoint) {
    return ForcesOfPulley(static_cast<b2PulleyJoint*>(joint), hz);
  }
  const b2Vec2 on_b = ForceOnB(joint, hz);
  return {-on_b, on_b};
}

}  // namespace seam
