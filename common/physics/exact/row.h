#pragma once
/// What the exact solver works on: bodies in double precision and the rows that bind them. A row
/// asks of the velocities v of its bodies  j v + gamma lambda = target,  where lambda, its impulse,
/// is kept within lo..hi.

#include <box2d/box2d.h>

#include <cmath>

namespace seam {

/// Two numbers that are divided, multiplied or added at once, each rounded as if it were alone.
using Two = double __attribute__((vector_size(16)));

/// A body of an island. Index below: into the island's list.
struct ExactBody {
  b2Body* body = nullptr;
  int group = -1;                ///< its mechanism; -1: none
  int slot = -1;                 ///< of the moving body; -1: anchored or kinematic
  double im = 0, ii = 0;         ///< 1/kg, 1/(kg m2) with what the joints' tension adds; 0: fixed
  double inertia = 0;            ///< kg m2, its own
  double x = 0, y = 0, a = 0;    ///< m, rad: centre of mass
  double c = 1, s = 0;           ///< cosine and sine of a
  double read_a = 0;             ///< rad: of what stands still, the angle that they are of
  double vx = 0, vy = 0, w = 0;  ///< m/s, rad/s
  double ax = 0, ay = 0, turn = 0;  ///< m/s2, rad/s2: by gravity and forces
  double slow = 0, slow_spin = 0;   ///< 1/s, damping
  double stiffness = 0;             ///< kg m2, h2 times the joints' tension times arm
  double lasting = 0;               ///< kg m2, the same, falling slowly
  double ii_before = 0;             ///< ii in the matrix
  int acts = 0;                     ///< how often a row acts on it
  bool moves() const { return im > 0; }

  /// Turns it by `d` rad; small angles by series, to the last bit or two.
  void Turn(double d) {
    a += d;
    if (std::fabs(d) > 0.05) {
      c = std::cos(a);
      s = std::sin(a);
      return;
    }
    const double q = d * d;
    const Two outer = q / Two{6, 12}, inner = q / Two{20, 30};  // of sine and cosine
    const double sine = d * (1 - outer[0] * (1 - inner[0] * (1 - q / 42)));
    const double cosine = 1 - q / 2 * (1 - outer[1] * (1 - inner[1]));
    const double old = c;
    c = c * cosine - s * sine;
    s = s * cosine + old * sine;
  }
};

enum class RowKind : unsigned char {
  kHard,      ///< a joint holds, whatever it takes
  kSoft,      ///< a spring, implicit
  kMotor,     ///< drives with at most so much
  kLimit,     ///< of a joint, pushes only
  kNormal,    ///< of a contact, pushes only
  kFriction,  ///< of a contact, at most a share of its normal's impulse
};

/// What becomes of a row in a solve.
enum class RowState : signed char {
  kLow = -1,  ///< its impulse is lo
  kFree = 0,  ///< its speed is the target
  kHigh = 1,  ///< its impulse is hi
  kOut = 2,   ///< takes no part
};

/// A moving body that a row binds.
struct RowEnd {
  int body = -1;
  double j[3] = {};   ///< per m/s, m/s, rad/s
  double mj[3] = {};  ///< what an impulse of 1 does: m/s, m/s, rad/s
};

struct Row {
  RowKind kind = RowKind::kHard;
  RowState state = RowState::kFree;
  int ends = 0;                     ///< of them there are
  RowEnd* end = nullptr;            ///< where they are: two, of a gear four
  double fixed_speed = 0;           ///< what its kinematic ends add, m/s or rad/s
  double error = 0;                 ///< m or rad: of the position; of a limit, what is left
  double goal = 0;                  ///< m or rad: the error that the substep is to end with
  double target = 0;                ///< m/s or rad/s
  double gamma = 0;                 ///< 1/kg or 1/(kg m2)
  double lo = 0, hi = 0;            ///< N s or N m s
  double lambda = 0;                ///< of this solve
  double warm = 0;                  ///< of the last substep: where a relaxation begins
  double base = 0;                  ///< of this substep, before this solve
  double total = 0;                 ///< of the step
  double stiff_a = 0, stiff_b = 0;  ///< m: tension's arm at the joint's two bodies
  int tense_a = -1, tense_b = -1;   ///< which bodies these are
  double most = 0;                  ///< bound of a motor; of a friction row, for now
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
