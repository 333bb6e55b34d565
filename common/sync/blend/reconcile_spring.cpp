/// spring: a damped spring from our copy to the authority's state, moved on to now; it acts in
/// every tick between two messages and only on velocities:
///   a = kp (xr' - x) + kd (vr' - v),   |a| <= cap
/// After BeamMP (its vehicle synchronisation, public source), which has 5 1/s^2, 5 1/s, a cap of
/// 100 m/s^2 and extrapolates by 0.3 s at most. If the copy did not accelerate as asked, something
/// blocks it, and the force is cut, so that two peers do not press a pile from both sides.

#include <algorithm>
#include <cmath>

#include "common/sync/blend/reconcile.h"

namespace seam {
namespace {

/// 1/s^2 and 1/s, about critical: kDamping^2 = 4 kStiffness. Measured beside 5/5 (cradle 0.19 m of
/// error instead of 0.05, peers 0.23 m apart in crossing with bots instead of 0.17) and 60/15 (a
/// shoved stack at 100 ms rocks with 3 m/s^2 instead of 1). kDamping times a tick must stay well
/// below 1.
constexpr float kStiffness = 20, kDamping = 9;
/// m/s^2 and rad/s^2. More lets a wrong message throw the copy about.
constexpr float kPullAccelerationMax = 100, kPullTurnMax = 100;
/// Above this spin the angle is not followed, rad/s: the wire lost its revolutions.
constexpr float kSpinFollowed = 15;
/// Farther off than this, m, the copy is placed: a spring would drag it through the scene.
constexpr float kPlaceBeyond = 8;
/// Longest extrapolation of a copy that is placed, s.
constexpr float kMovedOnMax = 0.3f;
/// A smaller pull, m/s, cannot tell whether the copy is blocked.
constexpr float kTellsFrom = 0.01f;
/// Below this share of the asked change, the copy is blocked.
constexpr float kBlockedBelow = 0.5f;
/// The force returns over this time, s. Shorter presses against the obstacle more often.
constexpr float kComesBack = 0.25f;

void GiveWay(const PullInput& in, PullMemory* memory) {
  const float asked = memory->asked.norm();
  if (asked > kTellsFrom) {
    const Vec2 along = memory->asked / asked;
    const float got = (in.local.velocity - memory->before).dot(along);
    // A standing body does not gain the velocity of a falling one: the more favourable reading
    // counts.
    const float most = std::max(got, got - in.drift.velocity.dot(along));
    if (most < kBlockedBelow * asked) {
      memory->share = 0;
      return;
    }
  }
  memory->share = std::min(1.0f, memory->share + in.step / kComesBack);
}

}  // namespace

Correction ReconcileSpring(const ReconcileInput& in) {
  Correction out;
  const BodyState d = Minus(Extrapolate(in.remote, std::min(in.dt, kMovedOnMax)), in.local);
  if (d.position.norm() > kPlaceBeyond) out.now = d;
  return out;
}

Correction PullSpring(const PullInput& in, PullMemory* memory) {
  GiveWay(in, memory);
  const BodyState d = Minus(in.target, in.local);
  Vec2 a = kStiffness * d.position + kDamping * d.velocity;
  if (a.norm() > kPullAccelerationMax) a *= kPullAccelerationMax / a.norm();
  const bool follows = std::fabs(in.target.spin) < kSpinFollowed;
  const float turn = (follows ? kStiffness * d.angle : 0.0f) + kDamping * d.spin;
  Correction out;
  out.now.velocity = (memory->share * in.step) * a;
  out.now.spin = memory->share * in.step * std::clamp(turn, -kPullTurnMax, kPullTurnMax);
  return out;
}

}  // namespace seam
