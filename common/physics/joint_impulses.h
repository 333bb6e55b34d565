#pragma once
/// Access to the private impulses of the engine's joints: the warm start of the next step, and the
/// source of the reactions.

#include <box2d/box2d.h>

namespace seam {

/// Pointers to a joint's impulses of the last step, N s or N m s. The order in `at`, by type:
/// revolute: x, y, motor, lower, upper; prismatic: across, angle, motor, lower, upper; wheel:
/// across, motor, spring, lower, upper; distance: along, lower, upper; weld and motor: x, y, angle.
struct JointImpulses {
  float* at[5] = {};
  int count = 0;
  float** begin() { return at; }
  float** end() { return at + count; }
};

/// Casts a joint to its own type.
template <typename Made>
Made& As(b2Joint* joint) {
  return *static_cast<Made*>(joint);
}

/// Requires a joint that MakeJoint has made.
JointImpulses ImpulsesOf(b2Joint* joint);

}  // namespace seam
