#pragma once
/// The data of the exact solver: bodies in double precision and the rows that bind them. A row
/// demands of its bodies' velocities v that  j v + gamma lambda = target,  where lambda, its
/// impulse, is kept within lo..hi.

#include <box2d/box2d.h>

#include <cmath>

#include "common/base/trig.h"

namespace seam {

/// Two numbers that are processed at once, each rounded as if alone.
using Two = double __attribute__((vector_size(16)));

/// A body of an island. `body` below is an index into the island's list.
struct ExactBody {
  b2Body* body = nullptr;
  int group = -1;                   ///< its mechanism; -1: none
  int slot = -1;                    ///< index of the moving body; -1: anchored or kinematic
  double im = 0, ii = 0;            ///< 1/kg, 1/(kg m2) including the joints' tension; 0: fixed
  double inertia = 0;               ///< kg m2, without tension
  double x = 0, y = 0, a = 0;       ///< m, rad: centre of mass
  double c = 1, s = 0;              ///< cosine and sine of a
  double read_a = 0;                ///< rad: angle of c and s, if the body is stationary
  double vx = 0, vy = 0, w = 0;     ///< m/s, rad/s
  double ax = 0, ay = 0, turn = 0;  ///< m/s2, rad/s2: by gravity and forces
  double slow = 0, slow_spin = 0;   ///< 1/s, damping
  double stiffness = 0;             ///< kg m2, h2 times the joints' tension times arm
  double lasting = 0;               ///< kg m2, the same, decaying slowly
  double ii_before = 0;             ///< ii in the matrix
  int acts = 0;                     ///< number of row ends at it
  bool moves() const { return im > 0; }

  /// Rotates the body by `d` rad; small angles by series, to the last bit or two.
  void Turn(double d) {
    a += d;
    if (std::fabs(d) > 0.05) {
      c = Cos(a);
      s = Sin(a);
      return;
    }
    const double q = d * d;
    const Two outer = q / Two{6, 12}, inner = q / Two{20, 30};  // for sine and cosine
    const double sine = d * (1 - outer[0] * (1 - inner[0] * (1 - q / 42)));
    const double cosine = 1 - q / 2 * (1 - outer[1] * (1 - inner[1]));
    const double old = c;
    c = c * cosine - s * sine;
    s = s * cosine + old * sine;
  }
};

enum class RowKind : unsigned char {
  kHard,      ///< a joint, unbounded
  kSoft,      ///< a spring, implicit
  kMotor,     ///< drives with a bounded impulse
  kLimit,     ///< a joint's limit, pushes only
  kNormal,    ///< a contact's normal, pushes only
  kFriction,  ///< a contact's friction, bounded by a share of its normal impulse
};

/// State of a row in a solve.
enum class RowState : signed char {
  kLow = -1,  ///< its impulse is lo
  kFree = 0,  ///< its speed is the target
  kHigh = 1,  ///< its impulse is hi
  kOut = 2,   ///< takes no part
};

/// A moving body at a row.
struct RowEnd {
  int body = -1;
  double j[3] = {};   ///< per m/s, m/s, rad/s
  double mj[3] = {};  ///< effect of an impulse of 1: m/s, m/s, rad/s
};

struct Row {
  RowKind kind = RowKind::kHard;
  RowState state = RowState::kFree;
  int ends = 0;            ///< number of ends
  RowEnd* end = nullptr;   ///< the ends: two, for a gear four
  double fixed_speed = 0;  ///< contribution of kinematic ends, m/s or rad/s
  double error = 0;        ///< m or rad: position error; for a limit, the remaining distance
  double goal = 0;         ///< m or rad: intended error at the substep's end
  double target = 0;       ///< m/s or rad/s
  double gamma = 0;        ///< 1/kg or 1/(kg m2)
  double lo = 0, hi = 0;   ///< N s or N m s
  double lambda = 0;       ///< impulse of this solve
  double warm = 0;         ///< impulse of the last substep: start of a relaxation
  double base = 0;         ///< impulse of this substep, before this solve
  double total = 0;        ///< impulse of the step
  double stiff_a = 0, stiff_b = 0;  ///< m: tension's arm at the joint's two bodies
  int tense_a = -1, tense_b = -1;   ///< those two bodies
  double most = 0;                  ///< bound of a motor; current bound of a friction row
  double friction = 0;              ///< coefficient
  bool bounded() const { return kind > RowKind::kSoft; }

  void End(int of, double jx, double jy, double jw) {
    RowEnd& to = end[ends++];
    to.body = of;
    to.j[0] = jx;
    to.j[1] = jy;
    to.j[2] = jw;
  }
};

constexpr double kUnbounded = 1e30;

}  // namespace seam
