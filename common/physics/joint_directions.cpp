#include "common/physics/joint_directions.h"

#include "common/physics/joint_impulses.h"
#include "common/physics/reveal.h"

namespace seam {
namespace {

SEAM_REVEAL(DistanceAlong, b2Vec2, b2DistanceJoint, m_u);
SEAM_REVEAL(PrismaticAlong, b2Vec2, b2PrismaticJoint, m_axis);
SEAM_REVEAL(PrismaticAcross, b2Vec2, b2PrismaticJoint, m_perp);
SEAM_REVEAL(WheelAlong, b2Vec2, b2WheelJoint, m_ax);
SEAM_REVEAL(WheelAcross, b2Vec2, b2WheelJoint, m_ay);
SEAM_REVEAL(PulleyUpA, b2Vec2, b2PulleyJoint, m_uA);
SEAM_REVEAL(PulleyUpB, b2Vec2, b2PulleyJoint, m_uB);
SEAM_REVEAL(GearAlong, b2Vec2, b2GearJoint, m_JvAC);
SEAM_REVEAL(GearTurn, float, b2GearJoint, m_JwA);

b2Vec2 Unit(b2Vec2 way) {
  way.Normalize();
  return way;
}

template <typename Made>
b2Vec2 AxisOf(Made& made) {
  return made.GetBodyA()->GetWorldVector(made.GetLocalAxisA());
}

void SetGear(b2GearJoint* gear) {
  b2Vec2& along = gear->*Member(GearAlong());
  float& turn = gear->*Member(GearTurn());
  along.SetZero();
  turn = 1;
  if (gear->GetJoint1()->GetType() != e_prismaticJoint) return;
  auto& slide = As<b2PrismaticJoint>(gear->GetJoint1());
  along = AxisOf(slide);
  turn = b2Cross(slide.GetAnchorB() - slide.GetBodyB()->GetWorldCenter(), along);
}

}  // namespace

void SetDirections(b2Joint* joint) {
  switch (joint->GetType()) {
    case e_distanceJoint:
      As<b2DistanceJoint>(joint).*Member(DistanceAlong()) =
          Unit(joint->GetAnchorB() - joint->GetAnchorA());
      break;
    case e_prismaticJoint: {
      auto& made = As<b2PrismaticJoint>(joint);
      made.*Member(PrismaticAlong()) = AxisOf(made);
      made.*Member(PrismaticAcross()) = b2Cross(1.0f, AxisOf(made));
      break;
    }
    case e_wheelJoint: {
      auto& made = As<b2WheelJoint>(joint);
      made.*Member(WheelAlong()) = AxisOf(made);
      made.*Member(WheelAcross()) = b2Cross(1.0f, AxisOf(made));
      break;
    }
    case e_pulleyJoint: {
      auto& made = As<b2PulleyJoint>(joint);
      made.*Member(PulleyUpA()) = Unit(made.GetAnchorA() - made.GetGroundAnchorA());
      made.*Member(PulleyUpB()) = Unit(made.GetAnchorB() - made.GetGroundAnchorB());
      break;
    }
    case e_gearJoint: SetGear(static_cast<b2GearJoint*>(joint)); break;
    default: break;  // other joints have the world's axes
  }
}

}  // namespace seam
