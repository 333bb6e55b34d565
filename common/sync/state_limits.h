#pragma once
/// Limits of corrections: maximum speed and spin, and differences too small to correct or to see.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/base/geometry.h"
#include "common/scene/scene_limits.h"
#include "common/sync/quantize.h"

namespace seam {

/// Above this spin, rad/s, the angle of a body (a wheel, a paddle) cannot be seen. Limbs are
/// usually slower (at 6 their jumps were visible).
constexpr float kSpinSeen = 12;
/// Most messages of future ticks that are kept until their tick; a hostile peer could send many.
constexpr std::size_t kEarlyMessagesMax = 64;

/// True if the wire's rounding explains the difference.
inline bool Negligible(const BodyState& d) {
  return d.position.norm() < 0.75f * kPositionQuantum &&
         std::fabs(d.angle) < 0.75f * static_cast<float>(kAngleQuantum) &&
         d.velocity.norm() < 1.5f * kVelocityQuantum && std::fabs(d.spin) < 1.5f * kVelocityQuantum;
}

inline BodyState WithinLimits(BodyState state, float speed_limit) {
  const float speed = state.velocity.norm();
  if (speed > speed_limit) state.velocity *= speed_limit / speed;
  state.spin = std::clamp(state.spin, -kSpinMax, kSpinMax);
  return state;
}

}  // namespace seam
