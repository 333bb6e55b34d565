#pragma once
/// A reason not to believe a client.

#include <cstdint>

#include "common/scene/types.h"

namespace seam {

/// A state that differs from the expected one.
struct Doubt {
  int body = -1;
  std::int64_t tick = 0;
  BodyState told, expected;
  float weight = 0;  ///< see TrustLadder
  bool refused = false;
};

}  // namespace seam
