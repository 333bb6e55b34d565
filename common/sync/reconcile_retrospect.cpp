/// retrospect (ours): compare states of the same tick, and carry the difference forward.
///   D = Xr(t1) - Xl(t1), Dv likewise;   X = Xl + D + Dv dt,   V = Vl + Dv
/// Exact whenever both peers' copies felt the same forces since t1: nothing is extrapolated through
/// gravity, spin or contact. A body that touches another authority's body is in a feedback loop
/// with delay (each peer corrects towards what the other corrected): there only a bounded share is
/// taken, without the Dv dt term, and nothing inside a dead band just above the quantisation.

#include <cmath>

#include "common/sync/reconcile.h"

namespace seam {
namespace {

/// Dead band for coupled bodies: 1.5 quanta of position (m), angle (rad) and velocity (m/s, rad/s).
/// Below one quantum resting copies never stop correcting each other; much above, error stands.
constexpr float kBandPosition = 1.5f / 512;
constexpr float kBandAngle = 3 * 9.58738e-5f;
constexpr float kBandVelocity = 1.5f / 256;

float Outside(float value, float band) { return std::fabs(value) > band ? value : 0.0f; }

Vec2 Outside(const Vec2& value, float band) {
  return value.norm() > band ? value : Vec2(0.0f, 0.0f);
}

}  // namespace

Correction ReconcileRetrospect(const ReconcileInput& in) {
  Correction out;
  if (in.local_then == nullptr) {  // nothing to compare with: start from the authority's state
    out.now = Minus(Extrapolate(in.remote, in.dt), in.local);
    return out;
  }
  out.rewrites_history = true;
  BodyState d = Minus(in.remote, *in.local_then);
  if (!in.coupled) {
    out.then = d;
    out.now = d;
    out.now.position += in.dt * d.velocity;
    out.now.angle += in.dt * d.spin;
    return out;
  }
  d.position = in.gain * Outside(d.position, kBandPosition);
  d.angle = in.gain * Outside(d.angle, kBandAngle);
  d.velocity = in.gain * Outside(d.velocity, kBandVelocity);
  d.spin = in.gain * Outside(d.spin, kBandVelocity);
  out.then = d;
  out.now = d;
  return out;
}

}  // namespace seam
