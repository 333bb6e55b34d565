#pragma once
/// Displayed and oracle's poses as columns of a review page: positions in whole millimetres, angles
/// in whole milliradians, errors in tenths of a millimetre, show ages in sixteenths of a tick.
///
/// Format of a section, all numbers varints:
///
///   first tick, number of ticks
///   runs over the ticks: index of the view's world in the page, -1 where there is no view
///   number of bodies; for each body:
///     id; number of spans; for each span: ticks since the end of the last one, length
///     x, y, angle: second differences, restarted in each span
///     runs: 3 * authority + role       (views only)
///     first differences of errors + 1; 0 where the oracle knows nothing  (views only)
///     first differences of show ages  (views only)

#include <functional>
#include <map>

#include "common/measure/oracle.h"
#include "common/record/recording.h"
#include "render/page/column.h"

namespace seam {

/// Unit of a page's position errors, m.
constexpr double kPageErrorUnit_m = 1e-4;
/// Unit of a page's show ages, ticks.
constexpr double kPageAgeUnit = 1.0 / 16;

/// Pose of a body at a tick.
struct TrackSample {
  std::int64_t tick = 0;
  double x = 0, y = 0, angle = 0;  ///< m, rad
  int authority = 0, role = 0;     ///< views only
  /// Views only: from the oracle's position at the tick that is shown, m; -1: not known.
  double error_m = -1;
  double age = 0;  ///< views only: show age, ticks
};
using Tracks = std::map<int, std::vector<TrackSample>>;  ///< by body, ticks ascending

/// Returns the tracks of a peer's views, with errors if `oracle` is not nullptr.
Tracks TracksOf(const std::map<std::int64_t, View>& views, const Oracle* oracle);
/// Returns the oracle's tracks of the bodies that views show.
Tracks TruthOf(const Recording& recording, const Oracle& oracle);

/// Encodes a section. `world_at`: returns the world of a tick, -1 where there is none. `views`:
/// with authority, error and show age.
PageBytes EncodeTracks(const Tracks& tracks, std::int64_t first_tick, std::int64_t last_tick,
                       const std::function<int(std::int64_t)>& world_at, bool views);

}  // namespace seam
