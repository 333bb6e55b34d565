#pragma once
/// The judges of the cases without an exact answer, each with its definition of the error.

#include <memory>

#include "tests/lab/hard/invariant_watch.h"

namespace seam {

struct DriftLimits {
  double away_m = kNoLimit;  ///< farther from where it began, a body fell
  /// Unit: the only direction of which drift is counted. Zero: all.
  Vec2 across{0, 0};
  /// s; drift counts from where a body is then. A shorter run is judged from its beginning.
  double settle_s = 0;
};

/// Error: the farthest, m, that any body came from where it was. Fails with "fell".
///
/// Piles are judged from the beginning but only across their weight, so that the engine's skin,
/// which lifts every row by 1.25 cm, is not called drift.
std::unique_ptr<Judge> MakeDriftJudge(const WatchLimits& limits, const DriftLimits& drift);

/// As MakeDriftJudge, and fails unless at the end all bodies lie: turned by more than half a radian
/// from how they stood.
std::unique_ptr<Judge> MakeToppleJudge(const WatchLimits& limits, const DriftLimits& drift);

/// Error: by how much, m, any body was ever farther from what holds it than its joints allow.
///
///     hook o---.                way: along the joints, hook to b's position, as at tick 0
///               `---o---.b      error: distance of b from the hook, minus the way; at least 0
///
/// The hook is the anchored joint with the shortest way. Errors of the joints on the way add up.
/// Bodies that no rigid joints hold to anything anchored are not judged. Fails with "came apart"
/// above `tear_m`.
std::unique_ptr<Judge> MakeReachJudge(const WatchLimits& limits, double tear_m, const Scene& scene);

/// Error: RMS over all bodies of how fast they moved, m/s, after `from_s` (in a run that ends
/// before: in its last tick). From positions: what the engine moves without giving it a velocity is
/// seen.
std::unique_ptr<Judge> MakeRestlessJudge(const WatchLimits& limits, double from_s);

/// Error: the greatest speed at which any body ever moved, m/s, from positions. Fails with "still
/// overlap" when at the end two parts are more than `overlap_m` into each other, by true shapes.
std::unique_ptr<Judge> MakeReleaseJudge(const WatchLimits& limits, double overlap_m,
                                        const Scene& scene);

/// Wanted height of a part, and the time from which it counts.
struct Arrival {
  std::string part;
  double height_m = 0;  ///< y of its position
  double from_s = 0;
  double sink_m = kNoLimit;  ///< more than this off it, it "is not up"
};

/// Error: the farthest, m, that the part's height was off.
std::unique_ptr<Judge> MakeArrivalJudge(const WatchLimits& limits, const Arrival& arrival,
                                        const Scene& scene);

}  // namespace seam
