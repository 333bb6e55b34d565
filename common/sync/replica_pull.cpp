/// Replica: copies that are pulled in every tick between two messages, by rules that ask for it.

#include "common/sync/replica.h"
#include "common/sync/state_limits.h"

namespace seam {
namespace {

/// The authority's state is moved on by this at most, s (BeamMP's). Farther, a car that braked is
/// looked for in the next street.
constexpr float kPullReckonMax = 0.3f;
/// Bodies stay coupled for this long after they last touched, s: contact flickers.
constexpr float kCoupledHold = 0.25f;

}  // namespace

BodyState Replica::PullTarget(int body, std::int64_t at) const {
  BodyState target = snapshots_.Extrapolate(body, at, world_.dt(), kPullReckonMax);
  target.angle = Unwrapped(target.angle, world_.Read(body).angle);
  return target;
}

void Replica::NoteArrival(int body) {
  Pull& pull = pulls_[static_cast<std::size_t>(body)];
  pull.arrived = tick();
  pull.arrival = world_.Read(body);
  pull.target_then = PullTarget(body, tick());
}

void Replica::PullCopies(std::int64_t next) {
  PullInput in;
  const float dt = world_.dt();
  const auto n = static_cast<float>(scene().solver.substeps);
  in.drift.velocity = dt * scene().gravity;
  in.drift.position = dt * dt * (n + 1) / (2 * n) * scene().gravity;  // velocity first, then place
  in.interval = static_cast<float>(config_.send_every()) * dt;
  in.step = dt;
  for (int body = 0; body < world_.body_count(); ++body) {
    Pull& pull = pulls_[static_cast<std::size_t>(body)];
    if (pull.arrived < dynamic_since_[static_cast<std::size_t>(body)]) continue;
    if (pull.arrived < 0 || RoleOf(world_.mechanism(body)) != kRoleSecondary) continue;
    // News from before a blow would undo it.
    if (snapshots_.newest_tick(body) <= last_impact_tick_[static_cast<std::size_t>(body)]) continue;
    const std::int64_t coupled_tick =
        last_coupled_tick_[static_cast<std::size_t>(world_.mechanism(body))];
    in.coupled = static_cast<float>(next - 1 - coupled_tick) * dt <= kCoupledHold;
    in.local = world_.Read(body);
    in.arrival = pull.arrival;
    in.target = PullTarget(body, next - 1);
    in.target_next = PullTarget(body, next);
    in.target_then = pull.target_then;
    in.since_arrival = static_cast<float>(next - 1 - pull.arrived) * dt;
    if (Negligible(Minus(in.target, in.local))) continue;
    const Correction c = config_.pull(in, &pull.memory);
    pull.memory.before = in.local.velocity;
    pull.memory.asked = c.now.velocity;
    world_.Write(body, WithinLimits(PlusScaled(in.local, c.now, 1), scene().speed_limit));
  }
}

}  // namespace seam
