#pragma once
/// Measures that a page cannot compute from poses rounded to millimetres: the sums of squares of
/// stutter and path error, tick by tick. Sums over a range of ticks give the output of seam-measure
/// for it, but the ages of path errors are those of the whole recording.

#include <map>
#include <vector>

#include "common/measure/mean_square.h"
#include "common/measure/oracle.h"
#include "render/page/column.h"

namespace seam {

/// Sums by peer, then by tick since the recording's first.
using PageSeries = std::map<int, std::vector<MeanSquare>>;

/// Returns stutter as common/measure defines it, (m/s^2)^2, at the last of its three ticks.
PageSeries StutterByTick(const Recording& recording, const Scene& scene, const Oracle& oracle);
/// Returns the path error of other players' bodies in clients' views, m^2.
PageSeries PathErrorByTick(const Recording& recording, const Scene& scene, const Oracle& oracle);

/// Encodes first differences of the counts, then of the root mean squares in `unit`, rounded.
PageBytes EncodeSeries(const std::vector<MeanSquare>& series, double unit);

}  // namespace seam
