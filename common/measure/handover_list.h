#pragma once
/// Every change of authority of a recording: how far the two authorities were apart at it, and how
/// long the body had none.

#include <string>
#include <vector>

#include "common/measure/revisions.h"
#include "common/record/recording.h"

namespace seam {

/// One mechanism's (or body's) change from one peer to another.
struct HandOverSeen {
  std::int64_t tick = 0;  ///< the first at which the new authority's view claims the body
  PartId id = 0;          ///< assembly
  int from = 0, to = 0;   ///< peers
  double gap_m = 0;       ///< between what both show of it at that tick
  double dv_mps = 0;      ///< between their velocities
  double without_s = 0;   ///< since the last tick at which the old one's view claimed it
};

/// In the order of ticks, then of bodies. What became another body meanwhile is left out.
/// `revisions`: nullptr where bodies never change.
std::vector<HandOverSeen> ListHandOvers(const Recording& recording,
                                        const RevisionHistory* revisions = nullptr);

/// The value that a share (0..1) of the changes does not exceed; 0 without changes.
double HandOverQuantile(const std::vector<HandOverSeen>& changes, double HandOverSeen::*field,
                        double share);

/// A line for each change, and one with the 95th percentiles.
std::string FormatHandOvers(const std::vector<HandOverSeen>& changes);

}  // namespace seam
