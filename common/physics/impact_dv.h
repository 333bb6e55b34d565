#pragma once
/// Effect of an impact on one of its two bodies.

#include "common/physics/world.h"

namespace seam {

/// Returns the change of velocity of one of the impact's bodies, m/s. Impact::dv is the larger of
/// the two; the impulse is the same for both. Requires body >= 0, one of the two.
inline float ChangeOfVelocity(const World& world, const Impact& impact, int body) {
  const int by = impact.body_a == body ? impact.body_b : impact.body_a;
  if (by < 0 || world.mass(by) >= world.mass(body)) return impact.dv;
  return impact.dv * world.mass(by) / world.mass(body);
}

}  // namespace seam
