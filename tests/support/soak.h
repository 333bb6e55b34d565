#pragma once
/// More of what is drawn at random: `make soak` runs the seeded tests with many times their seeds.

#include <cstdlib>

namespace seam {

/// `count` seeds or rounds, times the environment's SEAM_SOAK when that is a number above 1.
inline int Soak(int count) {
  const char* const factor = std::getenv("SEAM_SOAK");
  const int times = factor == nullptr ? 1 : std::atoi(factor);
  return times > 1 ? count * times : count;
}

}  // namespace seam
