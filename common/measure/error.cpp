/// Displayed pose against the oracle's of the view's tick and of the tick that is shown, over all
/// peers, ticks and bodies.

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/measure/mean_square.h"
#include "common/measure/parts.h"
#include "common/measure/percentile.h"

namespace seam {
namespace {

/// Returns the squared distance of a displayed position from the true one, m^2.
double SquaredDistance(const View& view, std::size_t i, const BodyState& truth) {
  const double dx = double{view.x[i]} - double{truth.position.x()};
  const double dy = double{view.y[i]} - double{truth.position.y()};
  return dx * dx + dy * dy;
}

}  // namespace

void MeasureError(const Recording& recording, const Oracle& oracle, Measures* measures) {
  measures->first_tick = recording.first_tick;
  const std::int64_t ticks = recording.last_tick - recording.first_tick + 1;
  std::vector<MeanSquare> by_tick(static_cast<std::size_t>(std::max<std::int64_t>(0, ticks)));
  std::vector<double> distances, shown_distances;
  MeanSquare all, angles, shown;
  for (const auto& [peer, views] : recording.views) {
    MeanSquare of_peer;
    for (const auto& [tick, view] : views) {
      for (std::size_t i = 0; i < view.id.size(); ++i) {
        const std::optional<BodyState> truth = oracle.At(tick, view.id[i]);
        if (!truth) continue;
        const double squared = SquaredDistance(view, i, *truth);
        const double turned = WrapAngle(double{view.angle[i]} - double{truth->angle});
        all.Add(squared);
        of_peer.Add(squared);
        angles.Add(turned * turned);
        distances.push_back(std::sqrt(squared));
        const auto due = oracle.AtMoment(MomentShown(view, i), view.id[i]);
        const double apart = due ? SquaredDistance(view, i, *due) : squared;
        shown.Add(apart);
        shown_distances.push_back(std::sqrt(apart));
        by_tick[static_cast<std::size_t>(tick - recording.first_tick)].Add(apart);
      }
    }
    if (of_peer.count > 0) measures->error_rms_by_peer_m[peer] = of_peer.RootOrZero();
  }
  measures->compared = all.count;
  measures->error_rms_m = all.RootOrZero();
  measures->error_rms_rad = angles.RootOrZero();
  measures->error_p95_m = Percentile(distances, 0.95);
  if (!distances.empty()) {
    measures->error_max_m = *std::max_element(distances.begin(), distances.end());
    measures->shown_error_max_m = *std::max_element(shown_distances.begin(), shown_distances.end());
  }
  measures->shown_error_rms_m = shown.RootOrZero();
  measures->shown_error_p95_m = Percentile(shown_distances, 0.95);
  for (const MeanSquare& of_tick : by_tick)
    measures->shown_error_by_tick_m.push_back(of_tick.RootOrZero());
}

}  // namespace seam
