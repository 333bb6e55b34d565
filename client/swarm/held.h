#pragma once
/// Of the bodies that move in a room: how many its clients simulate, each those it has authority
/// over, and how many are left to the server.

#include <vector>

#include "common/sync/replica.h"

namespace seam {

struct MovingBodies {
  double held = 0;    ///< by clients
  double server = 0;  ///< by the server
  double share() const { return held + server > 0 ? held / (held + server) : 0; }
  void Add(const MovingBodies& other) {
    held += other.held;
    server += other.server;
  }
};

/// Moving bodies that `peer` (0: the server) has authority over, as this copy shows them.
int MovingHeld(const Replica& replica, int peer);

}  // namespace seam
