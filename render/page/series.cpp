#include "render/page/series.h"

#include <cmath>

#include "common/measure/parts.h"
#include "common/measure/screen/path_error.h"

namespace seam {
namespace {

PageSeries EmptySeries(const Recording& recording) {
  PageSeries series;
  for (const auto& [peer, views] : recording.views)
    series[peer].resize(static_cast<std::size_t>(recording.last_tick - recording.first_tick + 1));
  return series;
}

/// Adds the path errors of one body in one peer's views, where it is not that peer's own.
void AddPathErrors(const Recording& recording, const std::vector<const View*>& views,
                   const BodyPath& truth, const RevisionHistory* changing, PartId id,
                   Screen& screen, std::vector<MeanSquare>* series) {
  double radius = -1;
  for (const View* view : views) {
    if (view == nullptr || IndexOf(*view, id) < 0) continue;
    radius = screen.extents.Of(view->revision, id).radius();
    break;
  }
  if (radius < 0) return;
  const BodyPath shown = ShownPath(recording, views, changing, id);
  const ViewAges ages(shown, truth, radius, std::max(1, recording.room.tick_hz));
  for (const View* view : views) {
    const int found = view == nullptr ? -1 : IndexOf(*view, id);
    if (found < 0 || screen.own.Has(*view, static_cast<std::size_t>(found))) continue;
    const std::optional<DoublePose> due = TruthShown(truth, ages, view->tick);
    if (!due) continue;
    const double d =
        screen.extents.Of(view->revision, id)
            .Displacement(DoublePose(StateIn(*view, static_cast<std::size_t>(found))), *due);
    (*series)[static_cast<std::size_t>(view->tick - recording.first_tick)].Add(d * d);
  }
}

}  // namespace

PageSeries StutterByTick(const Recording& recording, const Scene& scene, const Oracle& oracle) {
  PageSeries series = EmptySeries(recording);
  const RevisionHistory revisions(scene, recording);
  const RevisionHistory* changing = revisions.change() ? &revisions : nullptr;
  const double h = TickSeconds(recording);
  for (const auto& [peer, views] : recording.views) {
    for (const auto& [tick, view] : views) {
      const ViewTrio trio = {&view, FindView(views, tick - 1), FindView(views, tick - 2)};
      MeanSquare& of_tick = series[peer][static_cast<std::size_t>(tick - recording.first_tick)];
      for (std::size_t i = 0; i < view.id.size(); ++i) {
        const auto squared = StutterSquared(trio, i, oracle, changing, h);
        if (squared) of_tick.Add(*squared);
      }
    }
  }
  return series;
}

PageSeries PathErrorByTick(const Recording& recording, const Scene& scene, const Oracle& oracle) {
  PageSeries series = EmptySeries(recording);
  const RevisionHistory revisions(scene, recording);
  const RevisionHistory* changing = revisions.change() ? &revisions : nullptr;
  Screen screen(recording, &revisions);
  std::map<int, std::vector<const View*>> views;
  for (const auto& [peer, of_peer] : recording.views)
    if (peer >= 1) views[peer] = ViewsByTick(recording, peer);
  for (const PartId id : ShownIds(recording)) {
    const BodyPath truth = TruePath(recording, oracle, id);
    for (const auto& [peer, of_peer] : views)
      AddPathErrors(recording, of_peer, truth, changing, id, screen, &series[peer]);
  }
  return series;
}

PageBytes EncodeSeries(const std::vector<MeanSquare>& series, double unit) {
  std::vector<std::int64_t> counts, roots;
  for (const MeanSquare& of_tick : series) {
    counts.push_back(of_tick.count);
    roots.push_back(std::llround(std::min(of_tick.RootOrZero() / unit, 1e12)));
  }
  PageBytes out;
  PutUnsigned(&out, series.size());
  PutFirstDifferences(&out, counts);
  PutFirstDifferences(&out, roots);
  return out;
}

}  // namespace seam
