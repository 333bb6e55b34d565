#include <algorithm>

#include "common/measure/screen/noticed.h"
#include "common/measure/screen/thresholds.h"

namespace seam {
namespace {

/// Returns the lengths of the windows in ticks: 1, 2, 4, ... and half a second.
std::vector<std::int64_t> Windows(double h) {
  const std::int64_t longest = std::max<std::int64_t>(1, std::llround(kVelocityLong / h));
  std::vector<std::int64_t> windows;
  for (std::int64_t n = 1; n < longest; n *= 2) windows.push_back(n);
  windows.push_back(longest);
  return windows;
}

/// Returns the lengths of the oracle's steps in a span of ticks, shifted by the age at `aged`, m.
std::vector<double> TrueSteps(const ShownBody& body, std::int64_t from, std::int64_t to,
                              std::int64_t aged) {
  std::vector<double> steps;
  for (std::int64_t tick = from; tick < to; ++tick) {
    const std::optional<Place3> step = body.TrueWay(tick, tick + 1, aged);
    if (step) steps.push_back(step->norm());
  }
  return steps;
}

bool IsWrong(const ShownBody& body, std::int64_t tick, std::int64_t n) {
  if (!body.shown.Whole(tick - n, tick)) return false;
  const std::optional<Place3> due = body.TrueWay(tick - n, tick, tick);
  if (!due) return false;
  Place3 apart = Between(body.shown.At(tick - n), body.shown.At(tick), body.radius) - *due;
  // Both rotations are known up to whole turns.
  if (body.radius > 0) apart.z() = body.radius * WrapAngle(apart.z() / body.radius);
  const double off = apart.norm();
  const double tau = static_cast<double>(n) * body.h;
  if (off <= kWayFloor || off <= kVelocityFloor * tau) return false;
  // The oracle's mean speed, with a tick on either side: a bounce within the window cancels its
  // displacement.
  double way = 0;
  const std::vector<double> steps = TrueSteps(body, tick - n - 1, tick + 1, tick);
  for (const double step : steps) way += step;
  const double speed = steps.empty() ? 0 : way / (static_cast<double>(steps.size()) * body.h);
  return off > VelocityShare(tau, body.h) * speed * tau;
}

}  // namespace

std::vector<std::int64_t> WrongVelocities(const ShownBody& body) {
  std::vector<std::int64_t> ticks;
  const std::vector<std::int64_t> windows = Windows(body.h);
  for (std::int64_t tick = body.shown.first() + 1; tick <= body.shown.last(); ++tick) {
    const bool wrong = std::any_of(windows.begin(), windows.end(),
                                   [&](std::int64_t n) { return IsWrong(body, tick, n); });
    if (wrong) ticks.push_back(tick);
  }
  return ticks;
}

}  // namespace seam
