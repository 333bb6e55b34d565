#include <algorithm>
#include <cmath>

#include "common/measure/screen/noticed.h"
#include "common/measure/screen/thresholds.h"

namespace seam {
namespace {

using Eigen::Vector2d;

double Bend(const Vector2d& before, const Vector2d& after) {
  return std::abs(std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after)));
}

/// Returns the bend of the oracle's path over legs of `n` ticks at the tick that is shown at
/// `tick`; half a turn where the oracle is too slow for a direction, nullopt where it is not known.
std::optional<double> TrueBend(const ShownBody& body, std::int64_t tick, std::int64_t n,
                               std::int64_t aged) {
  const auto before = body.TrueWay(tick - n, tick, aged);
  const auto after = body.TrueWay(tick, tick + n, aged);
  if (!before || !after) return std::nullopt;
  const double least = kKinkSpeedMin / 2 * static_cast<double>(n) * body.h;
  const Vector2d a = before->head<2>(), b = after->head<2>();
  return std::min(a.norm(), b.norm()) < least ? kPi : Bend(a, b);
}

}  // namespace

std::vector<std::int64_t> Stops(const ShownBody& body) {
  std::vector<std::int64_t> ticks;
  const auto needed = static_cast<std::int64_t>(std::ceil(kStopLong / body.h - 1e-9));
  std::int64_t still = 0;
  for (std::int64_t tick = body.shown.first() + 1; tick <= body.shown.last(); ++tick) {
    bool stands = false;
    const auto due = body.TrueWay(tick - 1, tick, tick);
    if (due && body.shown.Whole(tick - 1, tick)) {
      const double way = Between(body.shown.At(tick - 1), body.shown.At(tick), body.radius).norm();
      stands = due->norm() >= kStopTruthMin * body.h && way < kStopShare * due->norm();
    }
    still = stands ? still + 1 : 0;
    if (still >= needed) ticks.push_back(tick);
  }
  return ticks;
}

std::vector<std::int64_t> Kinks(const ShownBody& body) {
  std::vector<std::int64_t> ticks;
  const std::int64_t n = std::max<std::int64_t>(1, std::llround(kKinkLeg / body.h));
  const std::int64_t reach = std::llround(kKinkReach / body.h);
  const double least = kKinkSpeedMin * static_cast<double>(n) * body.h;
  for (std::int64_t tick = body.shown.first() + n; tick + n <= body.shown.last(); ++tick) {
    if (!body.shown.Whole(tick - n, tick + n)) continue;
    const Vector2d at = body.shown.At(tick).position;
    const Vector2d before = at - body.shown.At(tick - n).position;
    const Vector2d after = body.shown.At(tick + n).position - at;
    if (std::min(before.norm(), after.norm()) < least) continue;
    const double bend = Bend(before, after);
    if (bend <= kKink || (after - before).norm() <= kWayFloor) continue;
    double due = 0;
    for (std::int64_t t = tick - reach; t <= tick + reach && bend - due > kKink; ++t) {
      due = std::max(due, TrueBend(body, t, n, tick).value_or(t == tick ? kPi : 0));
    }
    if (bend - due > kKink) ticks.push_back(tick);
  }
  return ticks;
}

}  // namespace seam
