/// Rebound: share of a collision's momentum that was transferred; 1: all of it, 0: none.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "common/measure/parts.h"

namespace seam {
namespace {

using Vec = Eigen::Vector2d;

/// A collision begins when the struck bodies' momentum changes in one tick by this share of its
/// greatest change.
constexpr double kOnset = 0.05;
/// Smaller changes are no collision, kg m/s.
constexpr double kPeakMin = 1e-6;
/// The momentum before the collision is the mean over this time, s.
constexpr double kMomentumBefore = 0.1;
/// The momentum after the collision is the mean between these times after it, s: later than
/// corrections that take one round trip, before friction takes effect.
constexpr double kAfterBegin = 0.25, kAfterEnd = 0.5;

/// Momentum of the struck assemblies after `tick`; nullopt while any of them is unknown.
using Momentum = std::optional<Vec>;

Momentum OfOracle(const Oracle& oracle, const std::map<PartId, double>& masses, std::int64_t tick) {
  Vec sum(0, 0);
  for (const auto& [id, mass] : masses) {
    const std::optional<BodyState> state = oracle.At(tick, id);
    if (!state) return std::nullopt;
    sum += mass * state->velocity.cast<double>();
  }
  return sum;
}

/// Returns the velocity of a body in the view of its authority; nullopt without such a view.
Momentum VelocityOf(const Recording& recording, PartId id, std::int64_t tick) {
  for (const auto& [peer, views] : recording.views) {
    const auto view = views.find(tick);
    if (view == views.end()) continue;
    const int k = IndexOf(view->second, id);
    if (k < 0) continue;
    const auto i = static_cast<std::size_t>(k);
    if (view->second.role[i] == kRoleAuthority) return Vec(view->second.vx[i], view->second.vy[i]);
  }
  return std::nullopt;
}

Momentum OfRun(const Recording& recording, const std::map<PartId, double>& masses,
               std::int64_t tick) {
  Vec sum(0, 0);
  for (const auto& [id, mass] : masses) {
    const Momentum velocity = VelocityOf(recording, id, tick);
    if (!velocity) return std::nullopt;
    sum += mass * *velocity;
  }
  return sum;
}

/// Returns the first tick of the collision, at `around_tick` or later.
std::optional<std::int64_t> Onset(const Oracle& oracle, const std::map<PartId, double>& masses,
                                  std::int64_t around_tick) {
  const std::int64_t begin = std::max(around_tick, oracle.first_tick + 1);
  const std::int64_t end = oracle.first_tick + static_cast<std::int64_t>(oracle.ticks.size());
  const Momentum start = OfOracle(oracle, masses, begin - 1);
  if (!start) return std::nullopt;
  double peak = 0;
  for (std::int64_t tick = begin; tick < end; ++tick) {
    const Momentum now = OfOracle(oracle, masses, tick);
    if (now) peak = std::max(peak, (*now - *start).norm());
  }
  if (peak < kPeakMin) return std::nullopt;
  for (std::int64_t tick = begin; tick < end; ++tick) {
    const Momentum now = OfOracle(oracle, masses, tick);
    const Momentum before = OfOracle(oracle, masses, tick - 1);
    if (now && before && (*now - *before).norm() > kOnset * peak) return tick;
  }
  return std::nullopt;
}

/// Returns the mean of `momentum(tick)` over the known ticks from `begin` to `end`, both included.
template <class Function>
Momentum Mean(std::int64_t begin, std::int64_t end, const Function& momentum) {
  Vec sum(0, 0);
  int count = 0;
  for (std::int64_t tick = begin; tick <= end; ++tick) {
    const Momentum now = momentum(tick);
    if (!now) continue;
    sum += *now;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return Vec(sum / count);
}

}  // namespace

std::optional<double> Rebound(const Recording& recording, const Oracle& oracle,
                              const std::map<PartId, double>& masses, std::int64_t around_tick) {
  const std::optional<std::int64_t> onset = Onset(oracle, masses, around_tick);
  if (masses.empty() || !onset) return std::nullopt;
  const double h = TickSeconds(recording);
  const auto ticks = [h](double seconds) { return std::llround(seconds / h); };
  const auto transfer = [&](const auto& momentum) -> Momentum {
    const Momentum before =
        Mean(*onset - std::max(1LL, ticks(kMomentumBefore)), *onset - 1, momentum);
    const Momentum after = Mean(*onset + ticks(kAfterBegin), *onset + ticks(kAfterEnd), momentum);
    if (!before || !after) return std::nullopt;
    return Vec(*after - *before);
  };
  if (!OfOracle(oracle, masses, *onset + ticks(kAfterEnd))) return std::nullopt;
  const Momentum due = transfer([&](std::int64_t tick) { return OfOracle(oracle, masses, tick); });
  const Momentum run = transfer([&](std::int64_t tick) { return OfRun(recording, masses, tick); });
  if (!due || !run || due->squaredNorm() < kPeakMin * kPeakMin) return std::nullopt;
  return run->dot(*due) / due->squaredNorm();
}

}  // namespace seam
