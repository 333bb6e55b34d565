#pragma once
/// A reason not to believe a client.

#include <cstdint>

#include "common/scene/types.h"

namespace seam {

/// A state that differs from the expected one, or that was told without what it takes to check it.
struct Doubt {
  int body = -1;
  std::int64_t tick = 0;
  BodyState told, expected;
  float weight = 0;  ///< see TrustLadder
  bool refused = false;
  bool left_out =
      false;  ///< nothing is known to differ: other bodies' states or inputs are missing
};

}  // namespace seam
