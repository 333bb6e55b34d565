#include "common/physics/exact/joint_rows.h"

#include <algorithm>

#include "common/base/check.h"
#include "common/physics/exact/gear_rows.h"

namespace seam {
namespace {

/// Share of its error that a pose motor corrects in a step; the engine's default.
constexpr double kPoseShare = 0.3;
/// Two points closer than this have no direction, m.
constexpr double kNoDirection = 1e-9;

/// Coefficients of the ends' velocities in a row's speed.
struct Jacobian {
  double ax, ay, aw, bx, by, bw;
};
constexpr Jacobian kTurn{0, 0, -1, 0, 0, 1};
constexpr Jacobian kTurnBack{0, 0, 1, 0, 0, -1};

/// Writes the rows of one joint.
class Writer {
 public:
  Writer(const ExactJoint& joint, const ExactJointEnds& ends, const std::vector<ExactBody>& bodies,
         const Pace& pace, Row* next)
      : joint_(joint),
        ends_(ends),
        a_(bodies[static_cast<std::size_t>(ends.a)]),
        b_(bodies[static_cast<std::size_t>(ends.b)]),
        h_(pace.h),
        step_(pace.h * pace.substeps),
        next_(next) {
    ax_ = a_.c * ends.ax - a_.s * ends.ay;
    ay_ = a_.s * ends.ax + a_.c * ends.ay;
    bx_ = b_.c * ends.bx - b_.s * ends.by;
    by_ = b_.s * ends.bx + b_.c * ends.by;
    dx_ = b_.x + bx_ - a_.x - ax_;
    dy_ = b_.y + by_ - a_.y - ay_;
  }

  void Point() {
    Row& x = Bind(RowKind::kHard, dx_, {-1, 0, ay_, 1, 0, -by_});
    Tense(-ax_, bx_, &x);
    Row& y = Bind(RowKind::kHard, dy_, {0, -1, -ax_, 0, 1, bx_});
    Tense(-ay_, by_, &y);
  }
  void Angle(RowKind kind, double error) { Bind(kind, error, kTurn); }
  Row& Along(RowKind kind, double error, double ux, double uy) {
    return Bind(kind, error, Line(ux, uy));
  }
  void Spring(Row* row) const {
    row->gamma = 1 / (h_ * (joint_.damping + h_ * joint_.stiffness));
    row->target = -row->error * h_ * joint_.stiffness * row->gamma;
    row->lo = -kUnbounded;
    row->hi = kUnbounded;
  }
  void Motor(Row* row) const {
    row->target = joint_.speed;
    row->most = joint_.most * h_;
    row->lo = -row->most;
    row->hi = row->most;
  }
  void Turning() { Motor(&Bind(RowKind::kMotor, 0, kTurn)); }
  void Hold() {
    Row& row = Bind(joint_.stiffness > 0 ? RowKind::kSoft : RowKind::kHard, turned(), kTurn);
    if (joint_.stiffness > 0) Spring(&row);
  }
  /// Writes the rows that keep `at` within the joint's range.
  void RangeOfAngle(double at) {
    if (joint_.near_lower) Bind(RowKind::kLimit, at - joint_.lower, kTurn);
    if (joint_.near_upper) Bind(RowKind::kLimit, joint_.upper - at, kTurnBack);
  }
  void RangeAlong(double at, double ux, double uy) {
    if (joint_.near_lower) Bind(RowKind::kLimit, at - joint_.lower, Line(ux, uy));
    if (joint_.near_upper) Bind(RowKind::kLimit, joint_.upper - at, Line(-ux, -uy));
  }
  double turned() const { return b_.a - a_.a - joint_.reference; }
  void Axis(double* ux, double* uy) const {
    const auto lx = static_cast<double>(joint_.axis.x), ly = static_cast<double>(joint_.axis.y);
    *ux = a_.c * lx - a_.s * ly;
    *uy = a_.s * lx + a_.c * ly;
  }
  double Shift(double ux, double uy) const { return dx_ * ux + dy_ * uy; }
  void Distance();
  void Pulley();
  void Pose();
  void Slide(bool turns);

 private:
  /// Returns the Jacobian of the distance along a line that turns with A.
  Jacobian Line(double ux, double uy) const {
    return {-ux, -uy, -((dx_ + ax_) * uy - (dy_ + ay_) * ux), ux, uy, bx_ * uy - by_ * ux};
  }
  Row& Bind(RowKind kind, double error, const Jacobian& j) {
    Row& row = *next_++;
    row.kind = kind;
    row.ends = 0;
    row.fixed_speed = 0;
    row.tense_a = row.tense_b = -1;
    row.gamma = 0;
    row.error = error;
    End(ends_.a, a_, j.ax, j.ay, j.aw, &row);
    End(ends_.b, b_, j.bx, j.by, j.bw, &row);
    row.lo = kind == RowKind::kLimit ? 0 : -kUnbounded;
    row.hi = kUnbounded;
    row.target = kind == RowKind::kLimit ? LimitTarget(error, h_) : HardTarget(error, h_);
    return row;
  }
  static void End(int place, const ExactBody& body, double x, double y, double w, Row* row) {
    if (body.moves()) {
      row->End(place, x, y, w);
    } else {
      row->fixed_speed += x * body.vx + y * body.vy + w * body.w;
    }
  }
  void Tense(double arm_a, double arm_b, Row* row) const {
    row->stiff_a = arm_a;
    row->stiff_b = arm_b;
    if (a_.moves()) row->tense_a = ends_.a;
    if (b_.moves()) row->tense_b = ends_.b;
  }

  const ExactJoint& joint_;
  const ExactJointEnds& ends_;
  const ExactBody& a_;
  const ExactBody& b_;
  const double h_, step_;     // s: of a substep, of the engine's step
  double ax_, ay_, bx_, by_;  // m, arms
  double dx_, dy_;            // m, from A's point to B's
  Row* next_;
};

void Writer::Distance() {
  const double length = std::sqrt(dx_ * dx_ + dy_ * dy_);
  const double ux = length > kNoDirection ? dx_ / length : 0;
  const double uy = length > kNoDirection ? dy_ / length : 1;
  // Does not turn with A: the line connects the points.
  const Jacobian along{-ux, -uy, -(ax_ * uy - ay_ * ux), ux, uy, bx_ * uy - by_ * ux};
  const Jacobian back{ux, uy, -along.aw, -ux, -uy, -along.bw};
  const double arm_a = ax_ * ux + ay_ * uy, arm_b = bx_ * ux + by_ * uy;
  if (IsRod(joint_)) {
    Tense(-arm_a, arm_b, &Bind(RowKind::kHard, length - joint_.lower, along));
    return;
  }
  if (joint_.stiffness > 0) {
    Spring(&Bind(RowKind::kSoft, length - joint_.reference, along));
  }
  if (joint_.near_lower) Tense(-arm_a, arm_b, &Bind(RowKind::kLimit, length - joint_.lower, along));
  if (joint_.near_upper) Tense(arm_a, -arm_b, &Bind(RowKind::kLimit, joint_.upper - length, back));
}

/// length = distance of a + ratio * distance of b; both ends are pulled up, as far as their stops.
void Writer::Pulley() {
  const auto way = [](double x, double y, const b2Vec2& ground, double* ux, double* uy) {
    *ux = x - static_cast<double>(ground.x);
    *uy = y - static_cast<double>(ground.y);
    const double length = std::sqrt(*ux * *ux + *uy * *uy);
    const double share = length > kNoDirection ? 1 / length : 0;
    *ux *= share;
    *uy *= share;
    return length;
  };
  double ux = 0, uy = 0, wx = 0, wy = 0;
  const double a = way(a_.x + ax_, a_.y + ay_, joint_.ground_a, &ux, &uy);
  const double b = way(b_.x + bx_, b_.y + by_, joint_.ground_b, &wx, &wy);
  const double ratio = joint_.ratio;
  const double turn_a = ax_ * uy - ay_ * ux, turn_b = bx_ * wy - by_ * wx;
  Bind(RowKind::kHard, joint_.length - a - ratio * b,
       {-ux, -uy, -turn_a, -ratio * wx, -ratio * wy, -ratio * turn_b});
  if (joint_.near_lower) Bind(RowKind::kLimit, a - kPulleyStop, {ux, uy, turn_a, 0, 0, 0});
  if (joint_.near_upper) Bind(RowKind::kLimit, b - kPulleyStop, {0, 0, 0, wx, wy, turn_b});
}

void Writer::Pose() {
  const auto& made = As<b2MotorJoint>(joint_);
  const b2Vec2 offset = made.GetLinearOffset();
  const auto ox = static_cast<double>(offset.x), oy = static_cast<double>(offset.y);
  // As in the engine: B's origin is at the offset in A's frame; the anchors are the bodies'
  // origins.
  const double wx = a_.c * ox - a_.s * oy, wy = a_.s * ox + a_.c * oy;
  const double ex = dx_ - wx, ey = dy_ - wy;
  const auto turn = static_cast<double>(made.GetAngularOffset());
  const double share = kPoseShare / step_;
  Row* first = next_;
  Bind(RowKind::kMotor, ex, {-1, 0, ay_ + wy, 1, 0, -by_});
  Bind(RowKind::kMotor, ey, {0, -1, -(ax_ + wx), 0, 1, bx_});
  Bind(RowKind::kMotor, b_.a - a_.a - turn, kTurn);
  for (int i = 0; i < 3; ++i) {
    Row& row = first[i];
    row.target = -share * row.error;
    row.most = h_ * static_cast<double>(i < 2 ? made.GetMaxForce() : made.GetMaxTorque());
    row.lo = -row.most;
    row.hi = row.most;
  }
}

void Writer::Slide(bool turns) {
  double ux = 0, uy = 0;
  Axis(&ux, &uy);
  const double at = Shift(ux, uy);
  Along(RowKind::kHard, Shift(-uy, ux), -uy, ux);
  if (!turns) Angle(RowKind::kHard, turned());
  if (turns && joint_.stiffness > 0) Spring(&Along(RowKind::kSoft, at, ux, uy));
  if (joint_.drives && turns) Turning();
  if (joint_.drives && !turns) Motor(&Along(RowKind::kMotor, 0, ux, uy));
  if (!joint_.limited) return;
  if (joint_.lower >= joint_.upper) {
    Along(RowKind::kHard, at - joint_.lower, ux, uy);
  } else {
    RangeAlong(at, ux, uy);
  }
}

}  // namespace

void FillJoint(const ExactJoint& joint, const ExactJointEnds& ends,
               const std::vector<ExactBody>& bodies, const Pace& pace, Row* rows) {
  if (joint.type == e_gearJoint) {
    FillGear(joint, ends, bodies, pace.h, rows);
    return;
  }
  Writer write(joint, ends, bodies, pace, rows);
  switch (joint.type) {
    case e_revoluteJoint: {
      write.Point();
      if (joint.drives) write.Turning();
      if (!joint.limited) break;
      const double turned = write.turned();
      if (joint.lower >= joint.upper) {
        write.Angle(RowKind::kHard, turned - joint.lower);
      } else {
        write.RangeOfAngle(turned);
      }
      break;
    }
    case e_weldJoint:
      write.Point();
      write.Hold();
      break;
    case e_prismaticJoint: write.Slide(false); break;
    case e_wheelJoint: write.Slide(true); break;
    case e_distanceJoint: write.Distance(); break;
    case e_pulleyJoint: write.Pulley(); break;
    case e_motorJoint: write.Pose(); break;
    default: break;
  }
}

}  // namespace seam
