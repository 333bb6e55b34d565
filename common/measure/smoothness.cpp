/// Smoothness of displayed motion: stutter that the oracle does not have, and backsteps.

#include <cmath>

#include "common/measure/mean_square.h"
#include "common/measure/parts.h"

namespace seam {
namespace {

/// Slower bodies have no direction to step against, m/s.
constexpr double kSpeedMin = 0.5;
/// Shorter steps cannot be seen, m.
constexpr double kStepMin = 0.001;

struct Point {
  double x = 0, y = 0;
};

Point Shown(const View& view, int i) {
  const auto index = static_cast<std::size_t>(i);
  return {view.x[index], view.y[index]};
}

Point At(const BodyState& state) { return {state.position.x(), state.position.y()}; }

/// True if the move from `a` to `b` goes against the velocity.
bool IsBackstep(const Point& a, const Point& b, double vx, double vy) {
  const double speed = std::hypot(vx, vy);
  if (speed <= kSpeedMin) return false;
  return ((b.x - a.x) * vx + (b.y - a.y) * vy) / speed < -kStepMin;
}

/// True if the body has the same parts in both views and in the oracle. A body with other parts
/// moves differently, so no difference is taken across such a change.
bool Same(const Oracle& oracle, const RevisionHistory* revisions, const View& now, const View& then,
          PartId id) {
  if (revisions != nullptr && !revisions->SameBody(now.revision, then.revision, id)) return false;
  return oracle.SameBody(now.tick, then.tick, id);
}

/// True if the body's last move goes against its velocity, and the oracle's does not.
bool IsOwnBackstep(const ViewTrio& trio, std::size_t i, const Oracle& oracle,
                   const RevisionHistory* revisions) {
  const View &now = *trio.now, &before = *trio.before;
  const PartId id = now.id[i];
  const std::optional<BodyState> truth = oracle.At(now.tick, id);
  const std::optional<BodyState> truth_before = oracle.At(now.tick - 1, id);
  const int k = IndexOf(before, id);
  if (!truth || !truth_before || k < 0 || !Same(oracle, revisions, now, before, id)) return false;
  return IsBackstep(Shown(before, k), {now.x[i], now.y[i]}, now.vx[i], now.vy[i]) &&
         !IsBackstep(At(*truth_before), At(*truth), truth->velocity.x(), truth->velocity.y());
}

}  // namespace

std::optional<double> StutterSquared(const ViewTrio& trio, std::size_t i, const Oracle& oracle,
                                     const RevisionHistory* revisions, double h) {
  if (trio.before == nullptr || trio.earlier == nullptr) return std::nullopt;
  const View &now = *trio.now, &before = *trio.before, &earlier = *trio.earlier;
  const PartId id = now.id[i];
  const std::int64_t tick = now.tick;
  const std::optional<BodyState> truth = oracle.At(tick, id);
  const std::optional<BodyState> truth_before = oracle.At(tick - 1, id);
  const std::optional<BodyState> truth_earlier = oracle.At(tick - 2, id);
  const int k = IndexOf(before, id), j = IndexOf(earlier, id);
  if (!truth || !truth_before || !truth_earlier || k < 0 || j < 0) return std::nullopt;
  if (!Same(oracle, revisions, now, before, id) || !Same(oracle, revisions, before, earlier, id)) {
    return std::nullopt;
  }
  const Point p = {now.x[i], now.y[i]}, q = Shown(before, k), r = Shown(earlier, j);
  const Point o = At(*truth), n = At(*truth_before), m = At(*truth_earlier);
  const double ax = (p.x - 2 * q.x + r.x) - (o.x - 2 * n.x + m.x);
  const double ay = (p.y - 2 * q.y + r.y) - (o.y - 2 * n.y + m.y);
  return (ax * ax + ay * ay) / (h * h * h * h);
}

void MeasureSmoothness(const Recording& recording, const Oracle& oracle,
                       const RevisionHistory* revisions, Measures* measures) {
  const double h = TickSeconds(recording);
  MeanSquare stutter;
  for (const auto& [peer, views] : recording.views) {
    for (const auto& [tick, view] : views) {
      const ViewTrio trio = {&view, FindView(views, tick - 1), FindView(views, tick - 2)};
      if (trio.before == nullptr) continue;
      for (std::size_t i = 0; i < view.id.size(); ++i) {
        if (IsOwnBackstep(trio, i, oracle, revisions)) ++measures->backsteps;
        const auto squared = StutterSquared(trio, i, oracle, revisions, h);
        if (squared) stutter.Add(*squared);
      }
    }
  }
  measures->stutter_mps2 = stutter.RootOrZero();
}

}  // namespace seam
