/// Computes only the errors of a joint's rows, as FillJoint does, for the corrections that close
/// joints.

#include <cmath>

#include "common/physics/exact/joint_rows.h"

namespace seam {
namespace {

/// Writes the errors of a range, in the order of its rows.
double* RangeErrors(const ExactJoint& joint, double at, double* next) {
  if (joint.limited && joint.lower >= joint.upper) {
    *next++ = at - joint.lower;
    return next;
  }
  if (joint.near_lower) *next++ = at - joint.lower;
  if (joint.near_upper) *next++ = joint.upper - at;
  return next;
}

}  // namespace

bool JointErrors(const ExactJoint& joint, const ExactJointEnds& ends,
                 const std::vector<ExactBody>& bodies, double* next) {
  const ExactBody& a = bodies[static_cast<std::size_t>(ends.a)];
  const ExactBody& b = bodies[static_cast<std::size_t>(ends.b)];
  const double dx = b.x + (b.c * ends.bx - b.s * ends.by) - a.x - (a.c * ends.ax - a.s * ends.ay);
  const double dy = b.y + (b.s * ends.bx + b.c * ends.by) - a.y - (a.s * ends.ax + a.c * ends.ay);
  const double turned = b.a - a.a - joint.reference;
  switch (joint.type) {
    case e_revoluteJoint:
      *next++ = dx;
      *next++ = dy;
      if (joint.drives) *next++ = 0;
      if (joint.limited) RangeErrors(joint, turned, next);
      return true;
    case e_weldJoint:
      *next++ = dx;
      *next++ = dy;
      *next++ = turned;
      return true;
    case e_prismaticJoint:
    case e_wheelJoint: {
      const auto lx = static_cast<double>(joint.axis.x), ly = static_cast<double>(joint.axis.y);
      const double ux = a.c * lx - a.s * ly, uy = a.s * lx + a.c * ly;
      const double at = dx * ux + dy * uy;
      *next++ = dy * ux - dx * uy;
      if (joint.type == e_prismaticJoint) *next++ = turned;
      if (joint.type == e_wheelJoint && joint.stiffness > 0) *next++ = at;
      if (joint.drives) *next++ = 0;
      if (joint.limited) RangeErrors(joint, at, next);
      return true;
    }
    case e_distanceJoint: {
      const double length = std::sqrt(dx * dx + dy * dy);
      if (IsRod(joint)) {
        *next = length - joint.lower;
        return true;
      }
      if (joint.stiffness > 0) *next++ = length - joint.reference;
      if (joint.near_lower) *next++ = length - joint.lower;
      if (joint.near_upper) *next++ = joint.upper - length;
      return true;
    }
    default: return false;
  }
}

}  // namespace seam
