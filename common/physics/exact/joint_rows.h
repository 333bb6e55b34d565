#pragma once
/// A joint of the engine as rows. The signs are the engine's: an impulse acts on body B as it is
/// and on A turned round, so that what is stored in the joint is read by everybody alike.

#include <algorithm>
#include <vector>

#include "common/physics/exact/row.h"
#include "common/physics/joint_impulses.h"

namespace seam {

/// The two joints that a gear couples.
struct GearSides {
  struct Side {
    bool slides = false;  ///< prismatic; else a hinge
    b2Vec2 base{0, 0}, arm{0, 0},
        axis{1, 0};        ///< m, of a prismatic joint, from the bodies' origins
    double reference = 0;  ///< rad, of a hinge
  };
  Side first, second;
  double ratio = 1;
};

/// A joint has at most so many rows, and a row so many ends.
constexpr int kJointRowsMost = 6, kRowEndsMost = 4;

/// A speed by which errors of position are shut at most, m/s or rad/s.
constexpr double kShutMost = 8;

/// Either end of a pulley's rope stops so near to where it goes up to, m: at that point itself the
/// rope has no direction. Ends are laid at least 0.1 m away.
constexpr double kPulleyStop = 0.02;

/// What does not change while the joint lives, but motors' speeds and bounds.
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
  /// Whether the limits are within reach of this step: others have no row. Of a pulley: a's end of
  /// the rope, and b's, are near their stops.
  bool near_lower = false, near_upper = false;
  double stiffness = 0, damping = 0;
  /// Its motor, N or N m.
  bool drives = false;
  double speed = 0, most = 0;
  GearSides gear;
  double ratio = 1, length = 0;           ///< of a pulley; m
  b2Vec2 ground_a{0, 0}, ground_b{0, 0};  ///< m, of a pulley
  JointImpulses impulses;
};

/// Whether a distance joint holds one length.
inline bool IsRod(const ExactJoint& joint) { return joint.lower >= joint.upper; }

/// Requires a joint that MakeJoint has made. The slots are left to the caller.
ExactJoint ReadJoint(b2Joint* made);

/// What may have changed since the last step: motor, near_lower and near_upper for a step of h s.
void LookAt(double h, ExactJoint* joint);

/// The two bodies of a joint, by their places in the island's list, and the points.
struct JointEnds {
  int a = 0, b = 0;
  double ax = 0, ay = 0, bx = 0, by = 0;  ///< m, in the body's frame, from the centre of mass
  int base_a = -1, base_b = -1;           ///< of a gear: what its joints turn or slide on
};

/// How many bodies each of its rows binds at most.
inline int EndsOf(const ExactJoint& joint) { return joint.type == e_gearJoint ? 4 : 2; }

/// How many rows it has now: limits may be far, motors may be switched.
int RowCount(const ExactJoint& joint);

/// The length of a substep, and how many there are in one of the engine's steps.
struct Pace {
  double h = 0;  ///< s
  int substeps = 1;
};

/// The speed, m/s or rad/s, that takes an error back in a substep of h s; of a limit, that uses up
/// what is left to it.
inline double HardTarget(double error, double h) {
  return std::clamp(-error / h, -kShutMost, kShutMost);
}
inline double LimitTarget(double error, double h) { return std::min(0.0, -error / h); }

/// Writes RowCount rows at `rows` for the bodies as they are. Impulses and
/// states are left alone. Always in the same order.
void FillJoint(const ExactJoint& joint, const JointEnds& ends, const std::vector<ExactBody>& bodies,
               const Pace& pace, Row* rows);

/// The errors of its rows alone, in their order. False: FillJoint finds them.
bool JointErrors(const ExactJoint& joint, const JointEnds& ends,
                 const std::vector<ExactBody>& bodies, double* errors);

/// The joint's stored impulses to its rows (warm start) as `share` of them, with their states.
void LoadImpulses(const ExactJoint& joint, double share, Row* rows);
/// The rows' totals to the joint.
void StoreImpulses(const ExactJoint& joint, const Row* rows);

}  // namespace seam
