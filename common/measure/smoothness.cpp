/// Smoothness of displayed motion: stutter that the oracle does not have, and backsteps.

#include <algorithm>
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

/// Returns the tick of a view, or the moment that it shows of body `i`.
double MomentOf(const View& view, int i, Truth truth) {
  return truth == Truth::kOfTick ? static_cast<double>(view.tick)
                                 : MomentShown(view, static_cast<std::size_t>(i));
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
  const int k = IndexOf(before, id);
  if (k < 0 || !Same(oracle, revisions, now, before, id)) return false;
  const std::optional<BodyState> truth = oracle.AtMoment(MomentShown(now, i), id);
  const std::optional<BodyState> truth_before =
      oracle.AtMoment(MomentShown(before, static_cast<std::size_t>(k)), id);
  if (!truth || !truth_before) return false;
  return IsBackstep(Shown(before, k), {now.x[i], now.y[i]}, now.vx[i], now.vy[i]) &&
         !IsBackstep(At(*truth_before), At(*truth), truth->velocity.x(), truth->velocity.y());
}

}  // namespace

std::optional<double> StutterSquared(const ViewTrio& trio, std::size_t i, const Oracle& oracle,
                                     const RevisionHistory* revisions, double h, Truth truth) {
  if (trio.before == nullptr || trio.earlier == nullptr) return std::nullopt;
  const View &now = *trio.now, &before = *trio.before, &earlier = *trio.earlier;
  const PartId id = now.id[i];
  const int l = static_cast<int>(i), k = IndexOf(before, id), j = IndexOf(earlier, id);
  if (k < 0 || j < 0) return std::nullopt;
  if (!Same(oracle, revisions, now, before, id) || !Same(oracle, revisions, before, earlier, id)) {
    return std::nullopt;
  }
  const auto due = oracle.AtMoment(MomentOf(now, l, truth), id);
  const auto due_before = oracle.AtMoment(MomentOf(before, k, truth), id);
  const auto due_earlier = oracle.AtMoment(MomentOf(earlier, j, truth), id);
  if (!due || !due_before || !due_earlier) return std::nullopt;
  const Point p = Shown(now, l), q = Shown(before, k), r = Shown(earlier, j);
  const Point o = At(*due), n = At(*due_before), m = At(*due_earlier);
  const double ax = (p.x - 2 * q.x + r.x) - (o.x - 2 * n.x + m.x);
  const double ay = (p.y - 2 * q.y + r.y) - (o.y - 2 * n.y + m.y);
  return (ax * ax + ay * ay) / (h * h * h * h);
}

void MeasureSmoothness(const Recording& recording, const Oracle& oracle,
                       const RevisionHistory* revisions, Measures* measures) {
  const double h = TickSeconds(recording);
  MeanSquare stutter, stutter_shown;
  for (const auto& [peer, views] : recording.views) {
    for (const auto& [tick, view] : views) {
      const ViewTrio trio = {&view, FindView(views, tick - 1), FindView(views, tick - 2)};
      if (trio.before == nullptr) continue;
      for (std::size_t i = 0; i < view.id.size(); ++i) {
        if (IsOwnBackstep(trio, i, oracle, revisions)) ++measures->backsteps;
        const auto squared = StutterSquared(trio, i, oracle, revisions, h, Truth::kOfTick);
        if (squared) stutter.Add(*squared);
        const auto shown = StutterSquared(trio, i, oracle, revisions, h);
        if (shown) stutter_shown.Add(*shown);
      }
    }
  }
  measures->stutter_mps2 = stutter.RootOrZero();
  measures->stutter_shown_mps2 = stutter_shown.RootOrZero();
}

}  // namespace seam
