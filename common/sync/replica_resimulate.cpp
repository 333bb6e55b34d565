/// Replica: going back to where a message is from, and stepping again from there.
///
///   barrier      t1 message                      now
///   --|-----------o-----|-----------|-----------|--o     all that came between two steps: one
///     restore --> put in ... step, step, step ...        replay, from the oldest t1
///
/// The authority's states are put in at every tick of which one is known, so what was heard before
/// is not forgotten. Our own bodies are stepped again, too: a collision that was otherwise than we
/// thought was so for both. Only where bodies of several authorities press against each other
/// without a blow, ours follow their history and the others' are corrected by a share: there each
/// peer would correct towards what the other corrected.

#include <utility>

#include "common/sync/replica.h"
#include "common/sync/state_limits.h"

namespace seam {
namespace {

/// Most ticks that are stepped again, 1 s at 60 Hz: a message that was longer under way is not
/// worth it. Less than the history.
constexpr std::int64_t kReplayMax = 60;
/// Of the difference, where bodies of several authorities press against each other. All of it
/// doubles the error of a shoved stack; much less is no longer a correction.
constexpr float kPressedShare = 0.3f;
/// What moves faster than this, m/s, or was struck, does not count as pressed.
constexpr float kPressedSpeed = 2;

}  // namespace

bool Replica::ReplayFrom(int body, std::int64_t tick) {
  if (barriers_.empty() || tick < barriers_.front().tick) return false;
  if (tick < dynamic_since_[static_cast<std::size_t>(body)]) return false;
  const BodyState* known = snapshots_.At(body, tick);
  if (known == nullptr) return true;  // a newer one was there before this
  const BodyState& then = *history_.At(tick, body);
  BodyState heard = *known;
  heard.angle = Unwrapped(heard.angle, then.angle);
  if (Negligible(Minus(heard, then))) return true;
  if (replay_from_ < 0 || tick < replay_from_) replay_from_ = tick;
  return true;
}

void Replica::TakeBarrier() {
  if (tick() % config_.send_every() != 0) return;
  barriers_.push_back(world_.Barrier());
  while (barriers_.front().tick < tick() - kReplayMax) barriers_.pop_front();
  while (!acted_.empty() && acted_.front().tick < barriers_.front().tick) acted_.pop_front();
}

std::vector<bool> Replica::FindPressed(std::int64_t from) const {
  std::vector<bool> pressed;
  for (const std::int64_t coupled : last_coupled_tick_) {
    pressed.push_back(coupled >= tick() - config_.tick_hz / 4);
  }
  for (int body = 0; body < world_.body_count(); ++body) {
    if (last_impact_tick_[static_cast<std::size_t>(body)] < from &&
        world_.Read(body).velocity.norm() < kPressedSpeed) {
      continue;
    }
    pressed[static_cast<std::size_t>(world_.mechanism(body))] = false;
  }
  return pressed;
}

bool Replica::FollowsHistory(int body, std::int64_t tick) const {
  const int mechanism = world_.mechanism(body);
  if (!Simulated(mechanism)) return true;
  if (tick <= dynamic_since_[static_cast<std::size_t>(body)]) return true;
  if (RoleOf(mechanism) != kRoleAuthority) return false;
  // What was told of a body at rest is bit for bit where it lies.
  return pressed_[static_cast<std::size_t>(mechanism)] || !world_.awake(body);
}

/// After the step to the world's tick: what is known of it.
void Replica::PutIn() {
  for (int body = 0; body < world_.body_count(); ++body) {
    BodyState* past = history_.At(tick(), body);
    if (FollowsHistory(body, tick())) {
      world_.Write(body, *past, false);
      continue;
    }
    const BodyState local = world_.Read(body);
    const BodyState* heard = snapshots_.At(body, tick());
    if (heard != nullptr && RoleOf(world_.mechanism(body)) == kRoleSecondary) {
      BodyState state = *heard;
      state.angle = Unwrapped(state.angle, local.angle);
      const bool moves = state.velocity.squaredNorm() > 0 || state.spin != 0;
      const bool pressed = pressed_[static_cast<std::size_t>(world_.mechanism(body))];
      state = PlusScaled(local, Minus(state, local), pressed ? kPressedShare : 1.0f);
      if (!Negligible(Minus(state, local))) {
        world_.Write(body, WithinLimits(state, scene().speed_limit), moves);
      }
    }
    *past = world_.Read(body);
  }
}

void Replica::StepAgain() {
  const std::int64_t next = tick() + 1;
  for (std::size_t p = 0; p < tracks_.size(); ++p) {
    world_.SetInput(static_cast<int>(p), tracks_[p].At(next));
  }
  for (int body = 0; body < world_.body_count(); ++body) {
    if (world_.motion(body) != Motion::kKinematic) continue;
    BodyState state = *history_.At(tick(), body);
    const BodyState& after = *history_.At(next, body);
    state.velocity = (after.position - state.position) / world_.dt();
    state.spin = (after.angle - state.angle) / world_.dt();
    world_.Write(body, WithinLimits(state, scene().speed_limit), state.velocity.norm() > 0);
  }
  for (const Acted& act : acted_) {
    if (act.tick == next) world_.Act(act.player, act.action);
  }
  world_.Step();
}

void Replica::Resimulate() {
  if (replay_from_ < 0) return;
  const std::int64_t from = std::exchange(replay_from_, -1);
  const std::int64_t now = tick();
  while (!barriers_.empty() && barriers_.back().tick > from) barriers_.pop_back();
  if (barriers_.empty()) return;
  std::vector<BodyState> shown;
  std::vector<bool> was_awake;
  for (int body = 0; body < world_.body_count(); ++body) {
    shown.push_back(world_.Read(body));
    was_awake.push_back(world_.awake(body));
  }
  pressed_ = FindPressed(from);
  world_.Restore(barriers_.back());
  PutIn();
  while (tick() < now) {
    StepAgain();
    PutIn();
    TakeBarrier();
  }
  for (int body = 0; body < world_.body_count(); ++body) {
    const auto b = static_cast<std::size_t>(body);
    if (FollowsHistory(body, now)) {
      world_.Write(body, shown[b], false);
      if (!was_awake[b]) world_.SetAwake(body, false);
    }
    smoother_.Moved(body, Minus(world_.Read(body), shown[b]));
  }
}

}  // namespace seam
