/// The error floor: growth of a displacement of a micrometre by chaos alone.

#include <algorithm>
#include <optional>

#include "common/measure/mean_square.h"
#include "common/measure/measure.h"
#include "common/measure/revisions.h"
#include "common/measure/screen/extent.h"

namespace seam {

double OracleDistance(const Recording& recording, const Oracle& a, const Oracle& b) {
  const Scene scene = RecordedScene(recording.room);
  const RevisionHistory revisions(scene, b.edits);
  Extents extents(&revisions);
  MeanSquare apart;
  std::size_t span = 0;
  for (std::size_t row = 0; row < b.ticks.size(); ++row) {
    while (span + 1 < b.spans.size() && b.spans[span + 1].first_row <= row) ++span;
    const int edits = b.spans.empty() ? 0 : b.spans[span].edits;
    const std::int64_t tick = b.first_tick + static_cast<std::int64_t>(row);
    const std::vector<PartId>& ids = b.IdsOf(row);
    for (std::size_t i = 0; i < b.ticks[row].size(); ++i) {
      if (ids[i] >= b.inserted_from) continue;  // may be another part in `a`
      const std::optional<BodyState> other = a.At(tick, ids[i]);
      if (!other) continue;
      const double moved =
          extents.Of(edits, ids[i]).Displacement(DoublePose(*other), DoublePose(b.ticks[row][i]));
      apart.Add(moved * moved);
    }
  }
  return apart.RootOrZero();
}

double ErrorFloor(const Recording& recording, const Oracle& oracle, float nudge, int bodies) {
  const int all = static_cast<int>(oracle.ids.size());
  const int chosen = std::min(bodies, all);
  if (chosen < 1) return 0;
  std::vector<double> distances;
  for (int k = 0; k < chosen; ++k) {
    OracleOptions options;
    options.nudged_body = k * all / chosen;
    options.nudge = nudge;
    distances.push_back(OracleDistance(recording, oracle, ComputeOracle(recording, options)));
  }
  const auto middle = distances.begin() + chosen / 2;
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

}  // namespace seam
