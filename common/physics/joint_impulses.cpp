#include "common/physics/joint_impulses.h"

#include "common/base/check.h"
#include "common/physics/reveal.h"

namespace seam {
namespace {

SEAM_REVEAL(RevolutePoint, b2Vec2, b2RevoluteJoint, m_impulse);
SEAM_REVEAL(RevoluteMotor, float, b2RevoluteJoint, m_motorImpulse);
SEAM_REVEAL(RevoluteLower, float, b2RevoluteJoint, m_lowerImpulse);
SEAM_REVEAL(RevoluteUpper, float, b2RevoluteJoint, m_upperImpulse);
SEAM_REVEAL(WheelLine, float, b2WheelJoint, m_impulse);
SEAM_REVEAL(WheelMotor, float, b2WheelJoint, m_motorImpulse);
SEAM_REVEAL(WheelSpring, float, b2WheelJoint, m_springImpulse);
SEAM_REVEAL(WheelLower, float, b2WheelJoint, m_lowerImpulse);
SEAM_REVEAL(WheelUpper, float, b2WheelJoint, m_upperImpulse);
SEAM_REVEAL(DistanceLine, float, b2DistanceJoint, m_impulse);
SEAM_REVEAL(DistanceLower, float, b2DistanceJoint, m_lowerImpulse);
SEAM_REVEAL(DistanceUpper, float, b2DistanceJoint, m_upperImpulse);
SEAM_REVEAL(PrismaticLine, b2Vec2, b2PrismaticJoint, m_impulse);
SEAM_REVEAL(PrismaticMotor, float, b2PrismaticJoint, m_motorImpulse);
SEAM_REVEAL(PrismaticLower, float, b2PrismaticJoint, m_lowerImpulse);
SEAM_REVEAL(PrismaticUpper, float, b2PrismaticJoint, m_upperImpulse);
SEAM_REVEAL(MotorPoint, b2Vec2, b2MotorJoint, m_linearImpulse);
SEAM_REVEAL(MotorTurn, float, b2MotorJoint, m_angularImpulse);
SEAM_REVEAL(WeldAll, b2Vec3, b2WeldJoint, m_impulse);
SEAM_REVEAL(GearAll, float, b2GearJoint, m_impulse);
SEAM_REVEAL(PulleyAll, float, b2PulleyJoint, m_impulse);

}  // namespace

JointImpulses ImpulsesOf(b2Joint* joint) {
  switch (joint->GetType()) {
    case e_revoluteJoint: {
      auto& j = As<b2RevoluteJoint>(joint);
      b2Vec2& point = j.*Member(RevolutePoint());
      return {{&point.x, &point.y, &(j.*Member(RevoluteMotor())), &(j.*Member(RevoluteLower())),
               &(j.*Member(RevoluteUpper()))},
              5};
    }
    case e_wheelJoint: {
      auto& j = As<b2WheelJoint>(joint);
      return {{&(j.*Member(WheelLine())), &(j.*Member(WheelMotor())), &(j.*Member(WheelSpring())),
               &(j.*Member(WheelLower())), &(j.*Member(WheelUpper()))},
              5};
    }
    case e_distanceJoint: {
      auto& j = As<b2DistanceJoint>(joint);
      return {{&(j.*Member(DistanceLine())), &(j.*Member(DistanceLower())),
               &(j.*Member(DistanceUpper()))},
              3};
    }
    case e_prismaticJoint: {
      auto& j = As<b2PrismaticJoint>(joint);
      b2Vec2& line = j.*Member(PrismaticLine());
      return {{&line.x, &line.y, &(j.*Member(PrismaticMotor())), &(j.*Member(PrismaticLower())),
               &(j.*Member(PrismaticUpper()))},
              5};
    }
    case e_motorJoint: {
      auto& j = As<b2MotorJoint>(joint);
      b2Vec2& point = j.*Member(MotorPoint());
      return {{&point.x, &point.y, &(j.*Member(MotorTurn()))}, 3};
    }
    case e_weldJoint: {
      b2Vec3& all = As<b2WeldJoint>(joint).*Member(WeldAll());
      return {{&all.x, &all.y, &all.z}, 3};
    }
    case e_gearJoint: return {{&(As<b2GearJoint>(joint).*Member(GearAll()))}, 1};
    case e_pulleyJoint: return {{&(As<b2PulleyJoint>(joint).*Member(PulleyAll()))}, 1};
    default: break;
  }
  SEAM_ASSERT(false);
  return {};
}

}  // namespace seam
