#pragma once
/// A gear as a row: the only kind of joint that binds more than two bodies.

#include <vector>

#include "common/physics/exact/joint_rows.h"

namespace seam {

/// Returns the two joints that the gear couples.
GearSides ReadGear(b2GearJoint* gear);

/// Writes its row, q1 + ratio q2 = 0, with q the angle of a hinge or the shift of a prismatic
/// joint. A body that belongs to both joints is one end. `h`: duration of a substep, s.
void FillGear(const ExactJoint& joint, const ExactJointEnds& ends,
              const std::vector<ExactBody>& bodies, double h, Row* row);

}  // namespace seam
