#pragma once
/// Checks a session's recording for exploding bodies, torn mechanisms and lost bodies: none may
/// occur in any scene and network. docs/metrics.md, "Soak".

#include <cstdint>
#include <functional>
#include <string>

#include "common/measure/oracle.h"
#include "common/record/recording.h"

namespace seam {

/// The worst values of one session. Each is 0 if the session equals the oracle's.
struct SoakFindings {
  /// Greatest kinetic energy of a body in a second, as a multiple of what is allowed: 1 is the bar.
  double energy = 0;
  std::string hottest;  ///< peer, body and second of it
  /// The same for the sum over all bodies; only in rooms without gravity or loss, else 0.
  double energy_sum = 0;
  /// Joint drift of any view beyond the oracle's own worst, and in a crash beyond what the engine
  /// made of it at that peer.
  double torn_m = 0;
  double crashed_m = 0;  ///< what the engine opened joints by in a crash, beyond the oracle's worst
  double missing_s = 0;  ///< longest that a body was in no client's view
  double off_m = 0;      ///< farthest that a client showed a body from where its authority did
  long compared = 0;     ///< number of compared poses
};

/// Largest joint error that the engine left in a peer's own world after a tick, m.
using PhysicsDriftOf = std::function<double(int peer, std::int64_t tick)>;

/// Requires a recording of a scene that parses, and its oracle.
SoakFindings CheckSoak(const Recording& recording, const Oracle& oracle,
                       const PhysicsDriftOf& physics_drift);

}  // namespace seam
