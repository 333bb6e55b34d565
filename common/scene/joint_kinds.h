#pragma once
/// What the kinds of joints are, for whoever need not know each. A new kind is asked for here, by a
/// switch without default: the compiler names every place that has to decide.

#include "common/scene/scene.h"

namespace seam {

/// What holds the two parts to each other.
enum class JointHold {
  kBond,     ///< all of it: the parts are as one, or bend a little (weld, glue)
  kPoint,    ///< a point of each (hinge, wheel)
  kAxis,     ///< a line along which they slide (prismatic)
  kLine,     ///< the distance between two points (distance, rope)
  kPose,     ///< a motor with bounded force (motor)
  kImposed,  ///< nothing: one part moves by a given path (kinematic)
  kCoupled,  ///< nothing of its own: how far two other joints have moved (gear)
  kPulley,   ///< the weighted sum of their distances to two fixed points (pulley)
};

inline JointHold HoldOf(JointKind kind) {
  switch (kind) {
    case JointKind::kWeld:
    case JointKind::kGlue: return JointHold::kBond;
    case JointKind::kRevolute:
    case JointKind::kWheel: return JointHold::kPoint;
    case JointKind::kPrismatic: return JointHold::kAxis;
    case JointKind::kDistance:
    case JointKind::kRope: return JointHold::kLine;
    case JointKind::kMotor: return JointHold::kPose;
    case JointKind::kKinematic: return JointHold::kImposed;
    case JointKind::kGear: return JointHold::kCoupled;
    case JointKind::kPulley: return JointHold::kPulley;
  }
  return JointHold::kBond;  // not reached: the switch has all kinds
}

/// What `limits` are in.
enum class JointLimits { kNone, kAngle, kLength, kShift };

inline JointLimits LimitsOf(JointKind kind) {
  switch (kind) {
    case JointKind::kRevolute: return JointLimits::kAngle;
    case JointKind::kDistance: return JointLimits::kLength;
    case JointKind::kWheel:
    case JointKind::kPrismatic: return JointLimits::kShift;
    case JointKind::kWeld:
    case JointKind::kGlue:
    case JointKind::kRope:
    case JointKind::kMotor:
    case JointKind::kKinematic:
    case JointKind::kGear:
    case JointKind::kPulley: return JointLimits::kNone;
  }
  return JointLimits::kNone;  // not reached
}

/// What the spring of a joint with a frequency acts on.
enum class JointSpring { kNone, kAngle, kAxis, kLength };

inline JointSpring SpringOf(JointKind kind) {
  switch (kind) {
    case JointKind::kWeld: return JointSpring::kAngle;
    case JointKind::kWheel: return JointSpring::kAxis;
    case JointKind::kDistance: return JointSpring::kLength;
    case JointKind::kGlue:
    case JointKind::kRevolute:
    case JointKind::kPrismatic:
    case JointKind::kRope:
    case JointKind::kMotor:
    case JointKind::kKinematic:
    case JointKind::kGear:
    case JointKind::kPulley: return JointSpring::kNone;
  }
  return JointSpring::kNone;  // not reached
}

}  // namespace seam
