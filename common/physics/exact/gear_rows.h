#pragma once
/// Gears as rows: the one kind of joint that binds more than two bodies.

#include <vector>

#include "common/physics/exact/joint_rows.h"

namespace seam {

/// The two joints that it couples.
GearSides ReadGear(b2GearJoint* gear);

/// Its one row, q1 + ratio q2 = 0, with q the angle of a hinge or the shift of a prismatic joint.
/// Bodies that both joints have are one end. `h`: s, of a substep.
void FillGear(const ExactJoint& joint, const JointEnds& ends, const std::vector<ExactBody>& bodies,
              double h, Row* row);

}  // namespace seam
