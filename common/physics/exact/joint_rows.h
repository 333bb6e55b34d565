#pragma once
/// A joint of the engine as rows. The signs are the engine's: an impulse acts on body B as it is
/// and on A reversed, so that a stored impulse means the same to both solvers.

#include <algorithm>
#include <vector>

#include "common/physics/exact/row.h"
#include "common/physics/joint_impulses.h"

namespace seam {

/// The two joints that a gear couples.
struct GearSides {
  struct Side {
    bool slides = false;                       ///< prismatic; else a hinge
    b2Vec2 base{0, 0}, arm{0, 0}, axis{1, 0};  ///< m, prismatic joint: from the bodies' origins
    double reference = 0;                      ///< rad, hinge
  };
  Side first, second;
  double ratio = 1;
};

/// Maximal number of rows of a joint, and of ends of a row.
constexpr int kJointRowsMost = 6, kRowEndsMost = 4;

/// Maximal speed at which position errors are corrected, m/s or rad/s.
constexpr double kShutMost = 8;

/// Distance from its ground anchor at which either end of a pulley's rope stops, m: at the anchor
/// itself the rope has no direction. A scene's ends are at least 0.1 m away.
constexpr double kPulleyStop = 0.02;

/// A joint's data. Only the motor's speed and bound, and near_lower and near_upper, change.
struct ExactJoint {
  b2Joint* made = nullptr;
  int index = -1;  ///< into Scene::joints
  b2JointType type = e_unknownJoint;
  int slot_a = -1, slot_b = -1;           ///< moving bodies; -1: anchored
  b2Vec2 anchor_a{0, 0}, anchor_b{0, 0};  ///< m, in the bodies' frames, from their origins
  b2Vec2 axis{1, 0};                      ///< unit, in A's frame
  double reference = 0;                   ///< rad
  bool limited = false;
  double lower = 0, upper = 0;  ///< rad or m
  /// True if the limit is within reach in this step; otherwise it has no row. For a pulley: a's and
  /// b's end of the rope is near its stop.
  bool near_lower = false, near_upper = false;
  double stiffness = 0, damping = 0;
  /// Motor; `most` in N or N m.
  bool drives = false;
  double speed = 0, most = 0;
  GearSides gear;
  double ratio = 1, length = 0;           ///< pulley; m
  b2Vec2 ground_a{0, 0}, ground_b{0, 0};  ///< pulley, m
  JointImpulses impulses;
};

/// Casts the engine's joint to its own type.
template <typename Made>
const Made& As(const ExactJoint& joint) {
  return *static_cast<const Made*>(joint.made);
}

/// True if a distance joint has a fixed length.
inline bool IsRod(const ExactJoint& joint) { return joint.lower >= joint.upper; }

/// Reads a joint that MakeJoint has made. The slots are left to the caller.
ExactJoint ReadJoint(b2Joint* made);

/// Updates the motor, and near_lower and near_upper for a step of h s.
void LookAt(double h, ExactJoint* joint);

/// The two bodies of a joint, as indices into the island's list, and the anchors.
struct ExactJointEnds {
  int a = 0, b = 0;
  double ax = 0, ay = 0, bx = 0, by = 0;  ///< m, in the body's frame, from the centre of mass
  int base_a = -1, base_b = -1;           ///< gear: bodies that its joints turn or slide on
};

/// Returns the maximal number of bodies that one of its rows binds.
inline int EndsOf(const ExactJoint& joint) { return joint.type == e_gearJoint ? 4 : 2; }

/// Returns the current number of rows: limits may be out of reach, motors may be switched.
int RowCount(const ExactJoint& joint);

/// Duration of a substep, and number of substeps in one of the engine's steps.
struct Pace {
  double h = 0;  ///< s
  int substeps = 1;
};

/// Returns the target speed, m/s or rad/s, that removes an error in a substep of h s; for a limit,
/// the speed that uses up the remaining distance.
inline double HardTarget(double error, double h) {
  return std::clamp(-error / h, -kShutMost, kShutMost);
}
inline double LimitTarget(double error, double h) { return std::min(0.0, -error / h); }

/// Writes RowCount rows at `rows` for the current bodies, always in the same order. Leaves impulses
/// and states alone.
void FillJoint(const ExactJoint& joint, const ExactJointEnds& ends,
               const std::vector<ExactBody>& bodies, const Pace& pace, Row* rows);

/// Computes only the errors of its rows, in their order. False if only FillJoint can.
bool JointErrors(const ExactJoint& joint, const ExactJointEnds& ends,
                 const std::vector<ExactBody>& bodies, double* errors);

/// Loads `share` of the joint's stored impulses into its rows (warm start) and sets the rows'
/// states.
void LoadImpulses(const ExactJoint& joint, double share, Row* rows);
/// Stores the rows' totals in the joint.
void StoreImpulses(const ExactJoint& joint, const Row* rows);

}  // namespace seam
