#pragma once
/// Number of random seeds: `make soak` runs the seeded tests with many times their usual number.

#include <cstdlib>

namespace seam {

/// Returns `count`, times the environment's SEAM_SOAK if that is a number above 1.
inline int Soak(int count) {
  const char* const factor = std::getenv("SEAM_SOAK");
  const int times = factor == nullptr ? 1 : std::atoi(factor);
  return times > 1 ? count * times : count;
}

}  // namespace seam
