/// retrospect (ours): compares states of the same tick and carries the difference forward.
///   D = Xr(t1) - Xl(t1), Dv likewise;   X = Xl + D + Dv dt,   V = Vl + Dv
/// Exact if both peers' copies felt the same forces since t1: nothing is extrapolated through
/// gravity, spin or contact. This holds for *free* differences: of a whole mechanism, in unblocked
/// directions. The remainder is the difference of springs, of joints, and of bodies pressed against
/// ground or each other. It does not grow like Dv dt (it swings back, or a contact removes it).
/// Where another authority's body presses on it, each peer corrects towards the other's correction:
/// a feedback loop with delay. Of the remainder only a bounded share is taken, without the Dv dt
/// term, and none inside a dead band just above the quantisation. A single free body gets no more
/// kinetic energy than its authority's had, plus our copy's gain since.

#include <cmath>

#include "common/codec/quanta.h"
#include "common/sync/blend/reconcile.h"

namespace seam {
namespace {

/// Dead band for coupled bodies: 1.5 quanta of position (m), angle (rad) and velocity (m/s, rad/s).
/// Below one quantum, resting copies never stop correcting each other; far above, error stays.
constexpr float kBandPosition = 1.5f * kPositionQuantum;
constexpr float kBandAngle = 3 * static_cast<float>(kAngleQuantum);
constexpr float kBandVelocity = 1.5f * kVelocityQuantum;

/// A newly simulated copy has no past to compare. Up to these differences, m and m/s, it waits for
/// one: placing a loaded wheel by a quantum makes it hop.
constexpr float kStartApart = 0.25f, kStartApartSpeed = 2.5f;
/// Most that one message moves a blocked difference, m: more is pushed into neighbours, which push
/// back.
constexpr float kBlockedMax = 0.05f;

Vec2 AtMost(float most, const Vec2& v) {
  const float size = v.norm();
  return size > most ? Vec2(v * (most / size)) : v;
}

float Outside(float value, float band) { return std::fabs(value) > band ? value : 0.0f; }

Vec2 Outside(const Vec2& value, float band) {
  return value.norm() > band ? value : Vec2(0.0f, 0.0f);
}

/// Returns the part of `v` perpendicular to every blocked direction.
Vec2 Unblocked(const ReconcileInput& in, Vec2 v) {
  for (int i = 0; i < in.blocked_count; ++i)
    v -= v.dot(in.blocked_directions[i]) * in.blocked_directions[i];
  return v;
}

}  // namespace

Correction ReconcileRetrospect(const ReconcileInput& in) {
  Correction out;
  if (in.local_then == nullptr) {  // nothing to compare: place only if far off
    const BodyState d = Minus(Extrapolate(in.remote, in.dt), in.local);
    if (d.position.norm() > kStartApart || d.velocity.norm() > kStartApartSpeed) out.now = d;
    return out;
  }
  out.rewrites_history = true;
  const BodyState d = Minus(in.remote, *in.local_then);
  BodyState free;  // the part independent of forces that both peers felt
  if (!in.coupled) {
    free.position = Unblocked(in, in.common.position);
    free.velocity = Unblocked(in, in.common.velocity);
    if (in.alone && in.blocked_count == 0) {
      free.angle = d.angle;
      free.spin = d.spin;
    }
  }
  const BodyState held = Minus(d, free);
  BodyState share;
  share.position = AtMost(kBlockedMax, in.gain * Outside(held.position, kBandPosition));
  share.angle = in.gain * Outside(held.angle, kBandAngle);
  share.velocity = in.gain * Outside(held.velocity, kBandVelocity);
  share.spin = in.gain * Outside(held.spin, kBandVelocity);
  out.then = PlusScaled(free, share, 1);
  out.now = out.then;
  out.now.position += in.dt * free.velocity;
  out.now.angle += in.dt * free.spin;
  // A velocity difference carried through an impact can point any way after it; in a room full of
  // impacts this feeds itself. Not for jointed bodies: they pass energy on to each other.
  if (in.alone && !in.coupled) {
    const Vec2 velocity = in.local.velocity + out.now.velocity;
    out.now.velocity = AtMost(in.speed_max, velocity) - in.local.velocity;
  }
  return out;
}

}  // namespace seam
