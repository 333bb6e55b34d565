#pragma once
/// The impulses that the engine's joints begin their next step with, and that it reads reactions
/// from: no getters, no setters.

#include <box2d/box2d.h>

namespace seam {

/// Where a joint keeps its impulses, N s or N m s, of the last step. What `at` holds, by type:
/// revolute: x, y, motor, lower, upper; prismatic: across, angle, motor, lower, upper; wheel:
/// across, motor, spring, lower, upper; distance: along, lower, upper; weld and motor: x, y, angle.
struct JointImpulses {
  float* at[5] = {};
  int count = 0;
  float** begin() { return at; }
  float** end() { return at + count; }
};

/// Requires a joint that MakeJoint has made.
JointImpulses ImpulsesOf(b2Joint* joint);

}  // namespace seam
