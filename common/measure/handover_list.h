#pragma once
/// Lists the changes of authority of a recording, each with the distance of the two authorities'
/// views and the time during which no peer had authority.

#include <string>
#include <vector>

#include "common/measure/revisions.h"
#include "common/record/recording.h"

namespace seam {

/// One change of authority over a body, as the views show it.
struct HandOverSeen {
  std::int64_t tick = 0;  ///< the first at which the new authority's view claims the body
  PartId id = 0;          ///< assembly
  int from = 0, to = 0;   ///< peers
  double gap_m = 0;       ///< distance of the two peers' displayed positions at that tick
  double dv_mps = 0;      ///< difference of their velocities
  double without_s = 0;   ///< time since the old authority's view last claimed the body
};

/// Returns the changes ordered by tick, then by peer and body. Leaves out a body if its parts
/// changed meanwhile. `revisions`: nullptr where bodies never change.
std::vector<HandOverSeen> ListHandOvers(const Recording& recording,
                                        const RevisionHistory* revisions = nullptr);

/// Returns the value that a share (0..1) of the changes does not exceed; 0 without changes.
double HandOverQuantile(const std::vector<HandOverSeen>& changes, double HandOverSeen::*field,
                        double share);

/// Formats a line for each change, and one with the 95th percentiles. "" without changes.
std::string FormatHandOvers(const std::vector<HandOverSeen>& changes);

}  // namespace seam
