#pragma once
/// What peers showed and where the oracle was, as the columns of a review page: positions in whole
/// millimetres, angles in whole milliradians, errors in tenths of a millimetre.
///
/// A section of tracks, all numbers varints:
///
///   first tick, number of ticks
///   runs over the ticks: which of the page's worlds the view shows, -1 where there is no view
///   number of bodies; of each body:
///     id; number of spans; of each span: ticks since the end of the last one, length
///     x, y, angle: second differences, anew in each span
///     runs: 3 * authority + role       (views only)
///     first differences of errors + 1; 0 where the oracle knows nothing  (views only)

#include <functional>
#include <map>

#include "common/measure/oracle.h"
#include "common/record/recording.h"
#include "render/page/column.h"

namespace seam {

/// Position error by which a page's numbers are computed, m.
constexpr double kPageErrorUnit_m = 1e-4;

/// Pose of a body at a tick.
struct TrackSample {
  std::int64_t tick = 0;
  double x = 0, y = 0, angle = 0;  ///< m, rad
  int authority = 0, role = 0;     ///< of views
  double error_m = -1;             ///< of views: from the oracle's position; -1: not known
};
using Tracks = std::map<int, std::vector<TrackSample>>;  ///< by body, ticks ascending

/// What a peer showed, with its errors where there is an oracle (or nullptr).
Tracks TracksOf(const std::map<std::int64_t, View>& views, const Oracle* oracle);
/// The oracle's paths of the bodies that views show.
Tracks TruthOf(const Recording& recording, const Oracle& oracle);

/// `world_at`: of a tick, -1 where there is none. `views`: with authority and error.
PageBytes EncodeTracks(const Tracks& tracks, std::int64_t first_tick, std::int64_t last_tick,
                       const std::function<int(std::int64_t)>& world_at, bool views);

}  // namespace seam
