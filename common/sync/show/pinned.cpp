#include "common/sync/show/pinned.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"

namespace seam {
namespace {

/// A gap below this counts as closed, m and rad: far below a pixel.
constexpr float kClosed = 1e-4f;
/// Inertia of bodies that are treated alike: that of a rod of twice the length.
constexpr float kHarderToTurn = 4;

float Beyond(float value, float lower, float upper) {
  return value - std::clamp(value, lower, upper);
}

/// Returns the part of a gap beyond the range from zero to `left`.
float TooMuch(float gap, float left) {
  return Beyond(gap, std::min(left, 0.0f), std::max(left, 0.0f));
}

Vec2 SpeedAt(const Vec2& at, const PinnedBody& body, const BodyState& moves) {
  const Vec2 arm = at - body.centre;
  return moves.velocity + moves.spin * Vec2(-arm.y(), arm.x());
}

void Narrow(float rest, float reach, float* lower, float* upper) {
  const float least = std::max(*lower, rest - reach), most = std::min(*upper, rest + reach);
  if (least > most) return;  // outside its limits
  *lower = least;
  *upper = most;
}

bool CloseTurn(float excess, PinnedBody* a, PinnedBody* b) {
  const float weight = a->inverse_inertia + b->inverse_inertia;
  if (std::fabs(excess) < kClosed || weight <= 0) return false;
  a->angle += excess * a->inverse_inertia / weight;
  b->angle -= excess * b->inverse_inertia / weight;
  a->moved = b->moved = true;
  return true;
}

/// Adds the response of the point at the arm to a unit impulse there.
void AddResponse(const PinnedBody& body, const Vec2& arm, Eigen::Matrix2f* k) {
  (*k)(0, 0) += body.inverse_mass + body.inverse_inertia * arm.y() * arm.y();
  (*k)(1, 1) += body.inverse_mass + body.inverse_inertia * arm.x() * arm.x();
  (*k)(0, 1) -= body.inverse_inertia * arm.x() * arm.y();
}

}  // namespace

PinnedBody::PinnedBody(const BodyState& pose, const MassPoint& mass)
    : centre(pose.position + Turned(mass.centre, pose.angle)),
      angle(pose.angle),
      inverse_mass(mass.mass > 0 ? 1 / mass.mass : 0),
      inverse_inertia(mass.inertia > 0 ? 1 / mass.inertia : 0),
      local(mass.centre) {}

Vec2 PinnedBody::ToWorld(const Vec2& point) const {
  return centre + Turned(Vec2(point - local), angle);
}

void PinnedBody::MakeAlike() {
  if (inverse_mass <= 0) return;
  inverse_inertia /= kHarderToTurn * inverse_mass;
  inverse_mass = 1;
}

void PinnedBody::Push(const Vec2& at, const Vec2& impulse) {
  const Vec2 arm = at - centre;
  centre += inverse_mass * impulse;
  angle += inverse_inertia * Cross(arm, impulse);
  moved = true;
}

PinGap GapOf(const Pin& pin, const PinnedBody& a, const PinnedBody& b) {
  PinGap gap;
  gap.at_a = a.ToWorld(pin.a.point);
  gap.at_b = b.ToWorld(pin.b.point);
  const Vec2 apart = gap.at_b - gap.at_a;
  const float length = apart.norm();
  gap.axis = Turned(pin.axis, a.angle);
  if (pin.by_distance && length > 0) gap.axis = apart / length;
  gap.along = gap.axis.dot(apart);
  gap.excess.x() = Beyond(gap.along, pin.lower, pin.upper);
  if (!pin.by_distance) gap.excess.y() = Cross(gap.axis, apart);
  // A view's angle may have lost whole turns, so a range of a turn or more constrains nothing.
  const float middle = (pin.angle_lower + pin.angle_upper) / 2;
  const float half = (pin.angle_upper - pin.angle_lower) / 2;
  if (half < kPiFloat) gap.turn = Beyond(WrapAngle(b.angle - a.angle - middle), -half, half);
  return gap;
}

Pin Within(Pin pin, const PinnedBody& a, const BodyState& a_moves, const PinnedBody& b,
           const BodyState& b_moves) {
  if (pin.swing > 0) {
    const PinGap gap = GapOf(pin, a, b);
    const Vec2 speed = SpeedAt(gap.at_b, b, b_moves) - SpeedAt(gap.at_b, a, a_moves);
    const float reach =
        std::fabs(gap.along - pin.rest) + std::fabs(gap.axis.dot(speed)) / pin.swing;
    Narrow(pin.rest, reach, &pin.lower, &pin.upper);
  }
  if (pin.turn_swing > 0) {
    const float reach = std::fabs(WrapAngle(b.angle - a.angle - pin.turn_rest)) +
                        std::fabs(b_moves.spin - a_moves.spin) / pin.turn_swing;
    Narrow(pin.turn_rest, reach, &pin.angle_lower, &pin.angle_upper);
  }
  return pin;
}

bool ClosePin(const Pin& pin, const PinLeft& left, PinnedBody* a, PinnedBody* b) {
  const bool turned = CloseTurn(TooMuch(GapOf(pin, *a, *b).turn, left.turn), a, b);
  const PinGap gap = GapOf(pin, *a, *b);
  const Vec2 off(TooMuch(gap.excess.x(), left.excess.x()),
                 TooMuch(gap.excess.y(), left.excess.y()));
  const float size = off.norm();
  if (size < kClosed) return turned;
  const Vec2 across(-gap.axis.y(), gap.axis.x());
  const Vec2 excess = gap.axis * off.x() + across * off.y();
  // A line is pushed at the place of b's point on it, not at its start.
  Vec2 at_a = gap.at_a;
  if (!pin.by_distance) at_a += gap.axis * (gap.along - gap.excess.x());
  Eigen::Matrix2f k = Eigen::Matrix2f::Zero();
  AddResponse(*a, at_a - a->centre, &k);
  AddResponse(*b, gap.at_b - b->centre, &k);
  Vec2 impulse;
  if (pin.lower == pin.upper && !pin.by_distance) {
    // Solves both coordinates at once.
    const float det = k(0, 0) * k(1, 1) - k(0, 1) * k(0, 1);
    if (det <= 0) return turned;
    impulse = Vec2(k(1, 1) * excess.x() - k(0, 1) * excess.y(),
                   k(0, 0) * excess.y() - k(0, 1) * excess.x()) /
              det;
  } else {
    const Vec2 n = excess / size;
    const float weight =
        n.x() * n.x() * k(0, 0) + 2 * n.x() * n.y() * k(0, 1) + n.y() * n.y() * k(1, 1);
    if (weight <= 0) return turned;
    impulse = n * (size / weight);
  }
  a->Push(at_a, impulse);
  b->Push(gap.at_b, -impulse);
  return true;
}

}  // namespace seam
