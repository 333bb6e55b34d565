#include "common/measure/screen/path_error.h"

#include <algorithm>

namespace seam {

std::optional<DoublePose> TruthShown(const BodyPath& truth, const ViewAges& ages,
                                     std::int64_t tick) {
  const double shown = static_cast<double>(tick) - ages.TicksAt(tick);
  const double at = std::max(shown, ages.begin());
  if (truth.Has(at)) return truth.At(at);
  if (truth.Has(tick)) return truth.At(tick);
  return std::nullopt;
}

void PathErrors::Add(const std::vector<const View*>& views, const BodyPath& truth,
                     const ViewAges& ages, PartId id, Screen& screen) {
  for (const View* view : views) {
    const int found = view == nullptr ? -1 : IndexOf(*view, id);
    if (found < 0) continue;
    const auto i = static_cast<std::size_t>(found);
    if (screen.own.Has(*view, i)) continue;
    const std::optional<DoublePose> due = TruthShown(truth, ages, view->tick);
    if (!due) continue;
    const double d =
        screen.extents.Of(view->revision, id).Displacement(DoublePose(StateIn(*view, i)), *due);
    squares_.Add(d * d);
    const ViewAge& span = ages.SpanOf(view->tick);
    if (!span.told) continue;
    ways_ += span.way;
    aged_ += span.way * span.ticks;
  }
}

void PathErrors::Report(double h, Measures* measures) const {
  measures->path_error_rms_m = squares_.Root();
  if (ways_ > 0) measures->view_age_ms = 1000 * h * aged_ / ways_;
}

}  // namespace seam
