#pragma once
/// Overlaps on a screen: bodies that a view shows deeper in each other than the oracle has them.

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "common/measure/overlap.h"
#include "common/measure/screen/noticed.h"
#include "common/measure/screen/screen.h"

namespace seam {

/// Two bodies by id, the lower first; kAnchoredBody stands for all that is anchored.
using BodyPair = std::pair<PartId, PartId>;
constexpr PartId kAnchoredBody = -1;

/// Overlap depths of one revision's bodies in views, and in the oracle at the ticks shown.
class ShownOverlaps {
 public:
  /// All must outlive this.
  ShownOverlaps(const SceneRevision& revision, const Oracle& oracle);

  /// An overlapping pair: its depth in the view, and beyond the oracle's, m.
  struct Found {
    BodyPair pair;
    double depth_m = 0, beyond_m = 0;
  };
  /// Returns the pairs that overlap in the view, or in the oracle at a tick that the view shows of
  /// one of the two: the oracle's depth is the larger of those two ticks'. Empty if the view lacks
  /// bodies of the revision.
  const std::vector<Found>& In(const View& view);

 private:
  using Depths = std::map<BodyPair, double>;
  Depths DepthsOf(const std::vector<BodyState>& states, std::int64_t tick) const;
  /// Returns the oracle's depths, by tick; empty where it lacks a body.
  const Depths& Due(std::int64_t tick);

  const SceneRevision& revision_;
  const Oracle& oracle_;
  const OverlapMeter meter_;
  std::map<std::int64_t, Depths> due_;
  std::vector<Found> found_;
};

/// Marks, in `seconds`, the ticks in which a pair of bodies has overlapped by more than
/// kOverlapFloor beyond the oracle for kOverlapLong or longer, in clients' views that show all
/// bodies. Sets overlap_p99_m.
void NoticeOverlaps(const Recording& recording, const Oracle& oracle,
                    const RevisionHistory& revisions, Screen& screen, BodySeconds* seconds,
                    Measures* measures);

}  // namespace seam
