#pragma once
/// What must never happen in a session, whatever its scene and network, from its recording: bodies
/// that explode, mechanisms that are torn, bodies that are lost. docs/metrics.md, "Soak".

#include <string>

#include "common/measure/oracle.h"
#include "common/record/recording.h"

namespace seam {

/// The worst of one session. Each is 0 in a session that is the oracle's.
struct SoakFindings {
  /// Greatest kinetic energy of a body in a second, as a multiple of what is allowed: 1 is the bar.
  double energy = 0;
  std::string hottest;  ///< peer, body and second of it
  /// The same of the sum over all bodies; only in rooms without gravity or loss, else 0.
  double energy_sum = 0;
  double torn_m = 0;     ///< joint drift of any view beyond the oracle's own worst
  double missing_s = 0;  ///< longest that a body was in no client's view
  double off_m = 0;      ///< farthest that a client showed a body from where its authority did
  long compared = 0;     ///< poses that were looked at
};

/// Requires a recording of a scene that parses, and its oracle.
SoakFindings CheckSoak(const Recording& recording, const Oracle& oracle);

}  // namespace seam
