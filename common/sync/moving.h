#pragma once
/// Test for moving bodies, for counts of the moving bodies that each peer simulates.

#include <cmath>

#include "common/physics/world.h"

namespace seam {

/// Slower bodies count as standing, m/s and rad/s.
constexpr float kMovingVelocity = 0.05f, kMovingSpin = 0.05f;

inline bool IsMoving(const World& world, int body) {
  if (!world.awake(body)) return false;
  const BodyState state = world.Read(body);
  return state.velocity.norm() > kMovingVelocity || std::abs(state.spin) > kMovingSpin;
}

}  // namespace seam
