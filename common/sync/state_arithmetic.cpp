#include "common/sync/state_arithmetic.h"

namespace seam {

BodyState Minus(const BodyState& a, const BodyState& b) { return PlusScaled(a, b, -1); }

BodyState PlusScaled(const BodyState& a, const BodyState& b, float s) {
  BodyState out;
  out.position = a.position + s * b.position;
  out.angle = a.angle + s * b.angle;
  out.velocity = a.velocity + s * b.velocity;
  out.spin = a.spin + s * b.spin;
  return out;
}

BodyState Extrapolate(const BodyState& remote, float dt) {
  BodyState out = remote;
  out.position += dt * remote.velocity;
  out.angle += dt * remote.spin;
  return out;
}

}  // namespace seam
