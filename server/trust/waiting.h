#pragma once
/// Messages of clients that wait for the server's own world.

#include <cstdint>

#include "common/codec/messages.h"

namespace seam {

/// States that wait for the server's copies of their tick.
struct WaitingStates {
  int peer = 0;
  std::int64_t since = 0;  ///< tick
  States states;
};

/// A proposal of a break that waits for the server's own world to feel the load.
struct WaitingBreak {
  int peer = 0;
  std::int64_t since = 0;  ///< tick
  EditOrder proposal;
};

}  // namespace seam
