#pragma once
/// Counts a room's moving bodies by authority: those of each client, and the server's.

#include <vector>

#include "common/sync/replica.h"

namespace seam {

struct MovingBodies {
  double held = 0;    ///< with a client's authority
  double server = 0;  ///< with the server's authority
  double share() const { return held + server > 0 ? held / (held + server) : 0; }
  void Add(const MovingBodies& other) {
    held += other.held;
    server += other.server;
  }
};

/// Returns the number of moving bodies under the authority of `peer` (0: the server), in this copy.
int MovingHeld(const Replica& replica, int peer);

}  // namespace seam
