#pragma once
/// What clients see of others against the oracle at the tick that is shown, and how old that is.

#include <optional>
#include <vector>

#include "common/measure/mean_square.h"
#include "common/measure/screen/age.h"
#include "common/measure/screen/screen.h"

namespace seam {

/// Where the oracle has the body at the tick that is shown at `tick`; before its first tick where
/// it was in that. nullopt where it is not known.
std::optional<DoublePose> TruthShown(const BodyPath& truth, const ViewAges& ages, std::int64_t tick);

/// path_error_rms_m and view_age_ms, body by body.
class PathErrors {
 public:
  /// One peer's views of one body, where it is not that peer's own.
  void Add(const std::vector<const View*>& views, const BodyPath& truth, const ViewAges& ages,
           PartId id, Screen& screen);
  /// `h`: s per tick.
  void Report(double h, Measures* measures) const;

 private:
  MeanSquare squares_;
  double ways_ = 0, aged_ = 0;  // m; m times ticks of age
};

}  // namespace seam
