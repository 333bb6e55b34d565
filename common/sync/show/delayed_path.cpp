#include "common/sync/show/delayed_path.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/sync/state_arithmetic.h"

namespace seam {
namespace {

constexpr double kSlewPerTick = 0.02;  // ticks of delay per tick: 2 % slower or faster
/// Largest turn between two ticks that is told from angles, rad/s: the engine clamps spins at 94.
constexpr float kSpinDrivenMax = 90.0f;

}  // namespace

double DisplayDelay::Advance() {
  if (ages_.empty()) return std::max(delay_, 0.0);
  const double target = static_cast<double>(ages_.Most() + 2 * interval_ticks_);
  if (delay_ < 0) delay_ = target;
  delay_ += std::clamp(target - delay_, -kSlewPerTick, kSlewPerTick);
  return delay_;
}

void DelayedPath::Begin(std::int64_t next) {
  const double before = delay_.ticks(), now = delay_.Advance();
  // Before the first state comes the delay is not known, and bodies stay where they began.
  if (delay_.ticks() < 0) return;
  here_ = static_cast<double>(next - 1) - (before < 0 ? now : before);
  there_ = static_cast<double>(next) - now;
}

PathSpeed DelayedPath::Speed(int body) const {
  const int ahead = IsPresent(world_.activity(body)) ? 1 : kShownEvery;
  if (delay_.ticks() < 0) return {};
  const BodyState here = Here(body), there = At(body, there_ + ahead - 1);
  const float seconds = static_cast<float>(ahead) * world_.dt();
  const float turn = WrapAngle(there.angle - here.angle);
  const bool fast =
      std::fabs(here.spin) * seconds > 1 || std::fabs(turn) > kSpinDrivenMax * seconds;
  return {(there.position - here.position) / seconds, fast ? there.spin : turn / seconds};
}

BodyState DelayedPath::At(int body, double tick) const {
  const double beyond = tick - static_cast<double>(snapshots_.newest_tick(body));
  const float dt = world_.dt();
  if (beyond <= 0) {
    return snapshots_.Interpolate(body, tick, dt, world_.scene().gravity, !world_.Joined(body));
  }
  const BodyState& newest = snapshots_.newest(body);
  const float seconds = std::min(static_cast<float>(beyond) * dt, kReckonShownMax);
  if (snapshots_.falls(body)) return world_.AfterFlight(body, newest, seconds);
  return Extrapolate(newest, seconds);
}

}  // namespace seam
