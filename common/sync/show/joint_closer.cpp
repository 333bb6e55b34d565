#include "common/sync/show/joint_closer.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/base/geometry.h"

namespace seam {
namespace {

/// A chain of n bodies, of which one is far off, needs about n sweeps; what is left after these is
/// seen as a joint that is open.
constexpr int kRoundsMax = 60;
/// Closed is what is nearer than this to where it should be, m and rad: far below a pixel.
constexpr float kClosed = 1e-4f;

/// A body on its way; what is anchored has no inverse mass.
struct Moving {
  Vec2 centre{0, 0};  ///< m, of mass
  float angle = 0;    ///< rad
  float inverse_mass = 0, inverse_inertia = 0;
  Vec2 local{0, 0};  ///< the centre in the body's frame
  bool moved = false;

  Moving() = default;
  Moving(const BodyState& pose, const MassPoint& mass)
      : centre(pose.position + Turned(mass.centre, pose.angle)),
        angle(pose.angle),
        inverse_mass(mass.mass > 0 ? 1 / mass.mass : 0),
        inverse_inertia(mass.inertia > 0 ? 1 / mass.inertia : 0),
        local(mass.centre) {}

  Vec2 ToWorld(const Vec2& point) const { return centre + Turned(Vec2(point - local), angle); }
  Vec2 position() const { return ToWorld(Vec2(0, 0)); }
  /// As an impulse acts on velocities, but at once and on the pose.
  void Push(const Vec2& at, const Vec2& impulse) {
    const Vec2 arm = at - centre;
    centre += inverse_mass * impulse;
    angle += inverse_inertia * Cross(arm, impulse);
    moved = true;
  }
};

struct Range {
  float lower = 0, upper = 0;
  float Excess(float value) const { return value - std::clamp(value, lower, upper); }
  void Include(float value) {
    lower = std::min(lower, value);
    upper = std::max(upper, value);
  }
};

/// A pin between two bodies of a list, and what it lets be.
struct Hold {
  const Pin* pin = nullptr;
  std::size_t a = 0, b = 0;  // indices into the list
  Range along, across, turn;
};

/// Where b's point is from a's, as Pin says it.
struct Gap {
  Vec2 at_a{0, 0}, at_b{0, 0};  ///< m, in the world
  Vec2 axis{1, 0};              ///< unit, in the world
  float along = 0, across = 0;  ///< m
  float turn = 0;               ///< rad, less the middle of its range
};

float MiddleOf(const Pin& pin) {
  return std::isfinite(pin.angle_lower) ? (pin.angle_lower + pin.angle_upper) / 2 : 0;
}

Gap GapOf(const Pin& pin, const Moving& a, const Moving& b) {
  Gap gap;
  gap.at_a = a.ToWorld(pin.a.point);
  gap.at_b = b.ToWorld(pin.b.point);
  const Vec2 apart = gap.at_b - gap.at_a;
  const float length = apart.norm();
  gap.axis = Turned(pin.axis, a.angle);
  if (pin.by_distance && length > 0) gap.axis = apart / length;
  gap.along = gap.axis.dot(apart);
  gap.across = pin.by_distance ? 0 : Cross(gap.axis, apart);
  gap.turn = WrapAngle(b.angle - a.angle - MiddleOf(pin));
  return gap;
}

/// Turns both so that the angle between them is in its range. Returns how far it was not, rad.
float CloseTurn(const Hold& hold, float turn, Moving* a, Moving* b) {
  if (!std::isfinite(hold.turn.lower) || hold.turn.upper > kPiFloat) return 0;
  const float excess = hold.turn.Excess(turn);
  const float weight = a->inverse_inertia + b->inverse_inertia;
  if (std::fabs(excess) < kClosed || weight <= 0) return 0;
  a->angle += excess * a->inverse_inertia / weight;
  b->angle -= excess * b->inverse_inertia / weight;
  a->moved = b->moved = true;
  return std::fabs(excess);
}

/// Moves both so that the points are where they should be. Returns how far they were not, m.
float ClosePoints(const Hold& hold, const Gap& gap, Moving* a, Moving* b) {
  const Vec2 across(-gap.axis.y(), gap.axis.x());
  const float along = hold.along.Excess(gap.along);
  const Vec2 excess = gap.axis * along + across * hold.across.Excess(gap.across);
  const float size = excess.norm();
  if (size < kClosed) return 0;
  // A line is pushed where b's point is on it, not where it begins.
  Vec2 at_a = gap.at_a;
  if (!hold.pin->by_distance) at_a += gap.axis * (gap.along - along);
  const Vec2 arm_a = at_a - a->centre, arm_b = gap.at_b - b->centre;
  Vec2 impulse;
  if (!hold.pin->by_distance && along != 0) {
    // Both coordinates at once.
    const auto row = [&](const Vec2& arm, float im, float ii, Eigen::Matrix2f* k) {
      (*k)(0, 0) += im + ii * arm.y() * arm.y();
      (*k)(1, 1) += im + ii * arm.x() * arm.x();
      (*k)(0, 1) -= ii * arm.x() * arm.y();
    };
    Eigen::Matrix2f k = Eigen::Matrix2f::Zero();
    row(arm_a, a->inverse_mass, a->inverse_inertia, &k);
    row(arm_b, b->inverse_mass, b->inverse_inertia, &k);
    const float det = k(0, 0) * k(1, 1) - k(0, 1) * k(0, 1);
    if (det <= 0) return 0;
    impulse = Vec2(k(1, 1) * excess.x() - k(0, 1) * excess.y(),
                   k(0, 0) * excess.y() - k(0, 1) * excess.x()) /
              det;
  } else {
    const Vec2 normal = excess / size;
    const float turn_a = Cross(arm_a, normal), turn_b = Cross(arm_b, normal);
    const float weight = a->inverse_mass + b->inverse_mass + a->inverse_inertia * turn_a * turn_a +
                         b->inverse_inertia * turn_b * turn_b;
    if (weight <= 0) return 0;
    impulse = normal * (size / weight);
  }
  a->Push(at_a, impulse);
  b->Push(gap.at_b, -impulse);
  return size;
}

}  // namespace

void JointCloser::Rebuild() {
  mechanisms_.assign(world_.composition().mechanisms.size(), {});
  for (int body = 0; body < world_.body_count(); ++body) {
    mechanisms_[static_cast<std::size_t>(world_.mechanism(body))].bodies.push_back(body);
  }
  for (const Pin& pin : world_.Pins()) {
    const int body = pin.a.body >= 0 ? pin.a.body : pin.b.body;
    mechanisms_[static_cast<std::size_t>(world_.mechanism(body))].pins.push_back(pin);
  }
}

void JointCloser::Close(int mechanism, bool simulated, std::vector<BodyState>* poses) const {
  const Jointed& jointed = At(mechanism);
  SEAM_ASSERT(static_cast<int>(poses->size()) == world_.body_count());
  std::vector<Moving> list, real;
  for (const int body : jointed.bodies) {
    const MassPoint mass = world_.mass_point(body);
    list.emplace_back((*poses)[static_cast<std::size_t>(body)], mass);
    if (simulated) real.emplace_back(world_.Read(body), mass);
  }
  const auto index = [&](const PinEnd& end) {
    if (end.body >= 0) {
      const auto at = std::lower_bound(jointed.bodies.begin(), jointed.bodies.end(), end.body);
      return static_cast<std::size_t>(at - jointed.bodies.begin());
    }
    list.emplace_back(world_.ReadAssembly(end.assembly), MassPoint{});
    if (simulated) real.push_back(list.back());
    return list.size() - 1;
  };
  std::vector<Hold> holds;
  for (const Pin& pin : jointed.pins) {
    Hold hold;
    hold.pin = &pin;
    hold.a = index(pin.a);
    hold.b = index(pin.b);
    hold.along = {pin.lower, pin.upper};
    hold.turn = {pin.angle_lower - MiddleOf(pin), pin.angle_upper - MiddleOf(pin)};
    if (simulated) {
      const Gap open = GapOf(pin, real[hold.a], real[hold.b]);
      hold.along.Include(open.along);
      hold.across.Include(open.across);
      hold.turn.Include(open.turn);
    }
    holds.push_back(hold);
  }
  for (int round = 0; round < kRoundsMax; ++round) {
    float worst = 0;
    for (std::size_t i = 0; i < holds.size(); ++i) {
      // To and fro, or what is off travels along a chain only a link a sweep.
      const Hold& hold = holds[round % 2 == 0 ? i : holds.size() - 1 - i];
      Moving &a = list[hold.a], &b = list[hold.b];
      worst = std::max(worst, CloseTurn(hold, GapOf(*hold.pin, a, b).turn, &a, &b));
      worst = std::max(worst, ClosePoints(hold, GapOf(*hold.pin, a, b), &a, &b));
    }
    if (worst == 0) break;
  }
  for (std::size_t i = 0; i < jointed.bodies.size(); ++i) {
    if (!list[i].moved) continue;
    BodyState& pose = (*poses)[static_cast<std::size_t>(jointed.bodies[i])];
    pose.position = list[i].position();
    pose.angle = list[i].angle;
  }
}

}  // namespace seam
