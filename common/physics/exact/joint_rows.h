#pragma once
/// A joint of the engine as rows. The signs are the engine's: an impulse acts on body B as it is
/// and on A turned round, so that what is stored in the joint is read by everybody alike.

#include <vector>

#include "common/physics/exact/row.h"
#include "common/physics/joint_impulses.h"

namespace seam {

/// What does not change while the joint lives, but motors' speeds and bounds.
struct ExactJoint {
  b2Joint* made = nullptr;
  b2JointType type = e_unknownJoint;
  int slot_a = -1, slot_b = -1;           ///< moving bodies; -1: anchored
  b2Vec2 anchor_a{0, 0}, anchor_b{0, 0};  ///< m, in the bodies' frames, from their origins
  b2Vec2 axis{1, 0};                      ///< unit, in A's frame
  double reference = 0;                   ///< rad
  bool limited = false;
  double lower = 0, upper = 0;  ///< rad or m
  /// Whether the limits are within reach of this step: others have no row.
  bool near_lower = false, near_upper = false;
  double stiffness = 0, damping = 0;
  JointImpulses impulses;
};

/// Requires a joint that MakeJoint has made. The slots are left to the caller.
ExactJoint ReadJoint(b2Joint* made);

/// Finds near_lower and near_upper for a step of h s.
void LookAtLimits(double h, ExactJoint* joint);

/// The two bodies of a joint, by their places in the island's list, and the points.
struct JointEnds {
  int a = 0, b = 0;
  double ax = 0, ay = 0, bx = 0, by = 0;  ///< m, in the body's frame, from the centre of mass
};

/// How many bodies each of its rows binds at most.
inline int EndsOf(const ExactJoint& /*joint*/) { return 2; }

/// How many rows it has now: limits may be far, motors may be switched.
int RowCount(const ExactJoint& joint);

/// The length of a substep, and how many there are in one of the engine's steps.
struct Pace {
  double h = 0;  ///< s
  int substeps = 1;
};

/// Writes RowCount rows at `rows` for the bodies as they are. Impulses and
/// states are left alone. Always in the same order.
void FillJoint(const ExactJoint& joint, const JointEnds& ends, const std::vector<ExactBody>& bodies,
               const Pace& pace, Row* rows);

/// The joint's stored impulses to its rows (warm start) as `share` of them, with their states.
void LoadImpulses(const ExactJoint& joint, double share, Row* rows);
/// The rows' totals to the joint.
void StoreImpulses(const ExactJoint& joint, const Row* rows);

}  // namespace seam
