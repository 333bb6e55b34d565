#pragma once
/// Path error: other players' bodies in clients' views against the oracle at the tick that is
/// shown, and the age of that tick.

#include <optional>
#include <vector>

#include "common/measure/mean_square.h"
#include "common/measure/screen/age.h"
#include "common/measure/screen/screen.h"

namespace seam {

/// Returns the oracle's pose at the tick that the view of `tick` shows, at the earliest
/// ViewAges::begin. nullopt where the pose is not known.
std::optional<DoublePose> TruthShown(const BodyPath& truth, const ViewAges& ages,
                                     std::int64_t tick);

/// Accumulates path_error_rms_m and view_age_ms, body by body.
class PathErrors {
 public:
  /// Adds one peer's views of one body, where it is not that peer's own.
  void Add(const std::vector<const View*>& views, const BodyPath& truth, const ViewAges& ages,
           PartId id, Screen& screen);
  /// Sets path_error_rms_m and view_age_ms. `h`: s per tick.
  void Report(double h, Measures* measures) const;

 private:
  MeanSquare squares_;
  double ways_ = 0, aged_ = 0;  // sums: m; m times ticks of age
};

}  // namespace seam
