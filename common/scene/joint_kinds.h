#pragma once
/// Properties of the kinds of joints, for code that need not know each kind. A new kind is added in
/// switches without default: the compiler reports every place that must handle it.

#include "common/scene/scene.h"

namespace seam {

/// The constraint between the two parts.
enum class JointHold {
  kBond,     ///< complete: rigid, or a little elastic (weld, glue)
  kPoint,    ///< a common point (hinge, wheel)
  kAxis,     ///< a common line along which they slide (prismatic)
  kLine,     ///< distance between two points (distance, rope)
  kPose,     ///< pose, by a motor with bounded force (motor)
  kImposed,  ///< none: one part moves along a given path (kinematic)
  kCoupled,  ///< none of its own: couples the motions of two other joints (gear)
  kPulley,   ///< weighted sum of the distances to two fixed points (pulley)
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
  return JointHold::kBond;  // not reached: the switch is complete
}

/// Quantity that the joint's limits bound.
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

/// Coordinate that the spring of a joint with a frequency acts on.
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
