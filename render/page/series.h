#pragma once
/// What of a peer's measures a page cannot compute from poses of a millimetre: the sums of squares
/// of stutter and path error, tick by tick. Sums over a range of ticks are those that seam-measure
/// prints of it, but for the ages of a path error, which are those of the whole recording.

#include <map>
#include <vector>

#include "common/measure/mean_square.h"
#include "common/measure/oracle.h"
#include "render/page/column.h"

namespace seam {

/// By peer, by tick since the recording's first.
using PageSeries = std::map<int, std::vector<MeanSquare>>;

/// Stutter as common/measure defines it, (m/s^2)^2 at the last of its three ticks.
PageSeries StutterByTick(const Recording& recording, const Scene& scene, const Oracle& oracle);
/// Path error of others' bodies as clients show them, m^2.
PageSeries PathErrorByTick(const Recording& recording, const Scene& scene, const Oracle& oracle);

/// First differences of the counts, then of the root mean squares in `unit`, rounded.
PageBytes EncodeSeries(const std::vector<MeanSquare>& series, double unit);

}  // namespace seam
