/// What the eye sees: jerks that the oracle does not have, and steps against the motion.

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

/// Whether the move from `a` to `b` goes against the velocity.
bool IsBackstep(const Point& a, const Point& b, double vx, double vy) {
  const double speed = std::hypot(vx, vy);
  if (speed <= kSpeedMin) return false;
  return ((b.x - a.x) * vx + (b.y - a.y) * vy) / speed < -kStepMin;
}

/// Goes over all pairs of neighbouring views: `steps_back` counts displayed moves against the
/// motion, `visit` takes the differences of stutter.
void Visit(const Recording& recording, const Oracle& oracle, const RevisionHistory* revisions,
           std::int64_t* steps_back, const StutterVisitor& visit) {
  const double h = TickSeconds(recording);
  // What a body becomes part of moves otherwise than it did: no difference is taken across that.
  const auto same = [&](const View& now, const View& then, PartId id) {
    if (revisions != nullptr && !revisions->SameBody(now.revision, then.revision, id)) return false;
    return oracle.SameBody(now.tick, then.tick, id);
  };
  for (const auto& [peer, views] : recording.views) {
    for (const auto& [tick, view] : views) {
      const View* before = FindView(views, tick - 1);
      if (before == nullptr) continue;
      const View* earlier = FindView(views, tick - 2);
      for (std::size_t i = 0; i < view.id.size(); ++i) {
        const PartId id = view.id[i];
        const std::optional<BodyState> truth = oracle.At(tick, id);
        const std::optional<BodyState> truth_before = oracle.At(tick - 1, id);
        const int k = IndexOf(*before, id);
        if (!truth || !truth_before || k < 0 || !same(view, *before, id)) continue;
        const Point p = {view.x[i], view.y[i]}, q = Shown(*before, k);
        const Point o = At(*truth), n = At(*truth_before);
        if (IsBackstep(q, p, view.vx[i], view.vy[i]) &&
            !IsBackstep(n, o, truth->velocity.x(), truth->velocity.y())) {
          ++*steps_back;
        }
        const std::optional<BodyState> truth_earlier = oracle.At(tick - 2, id);
        const int j = earlier == nullptr ? -1 : IndexOf(*earlier, id);
        if (!truth_earlier || j < 0 || !same(*before, *earlier, id)) continue;
        const Point r = Shown(*earlier, j), m = At(*truth_earlier);
        const double ax = (p.x - 2 * q.x + r.x) - (o.x - 2 * n.x + m.x);
        const double ay = (p.y - 2 * q.y + r.y) - (o.y - 2 * n.y + m.y);
        visit(peer, tick, (ax * ax + ay * ay) / (h * h * h * h));
      }
    }
  }
}

}  // namespace

void VisitStutter(const Recording& recording, const Oracle& oracle,
                  const RevisionHistory* revisions, const StutterVisitor& visit) {
  std::int64_t steps_back = 0;
  Visit(recording, oracle, revisions, &steps_back, visit);
}

void MeasureSmoothness(const Recording& recording, const Oracle& oracle,
                       const RevisionHistory* revisions, Measures* measures) {
  MeanSquare stutter;
  Visit(recording, oracle, revisions, &measures->backsteps,
        [&](int, std::int64_t, double squared) { stutter.Add(squared); });
  measures->stutter_mps2 = stutter.RootOrZero();
}

}  // namespace seam
