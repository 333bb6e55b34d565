#include "common/sync/correct/replay.h"

#include <utility>

#include "common/base/geometry.h"
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

Replay::Replay(const SyncConfig& config, World& world, const Roles& roles, BodyMemory& memory,
               Display& display, const std::vector<InputTrack>& inputs)
    : config_(config),
      world_(world),
      roles_(roles),
      memory_(memory),
      display_(display),
      inputs_(inputs) {}

bool Replay::Ask(int body, std::int64_t tick) {
  if (barriers_.empty() || tick < barriers_.front().tick) return false;
  if (tick < memory_.track(body).dynamic_since) return false;
  const BodyState* known = memory_.snapshots().At(body, tick);
  if (known == nullptr) return true;  // a newer one was there before this
  const BodyState& then = *memory_.history().At(tick, body);
  BodyState heard = *known;
  heard.angle = UnwrapAngle(heard.angle, then.angle);
  if (Negligible(Minus(heard, then))) return true;
  if (from_ < 0 || tick < from_) from_ = tick;
  return true;
}

void Replay::TakeBarrier() {
  if (!config_.resimulates || world_.tick() % config_.send_every() != 0) return;
  barriers_.push_back(world_.Barrier());
  while (barriers_.front().tick < world_.tick() - kReplayMax) barriers_.pop_front();
  while (!actions_.empty() && actions_.front().tick < barriers_.front().tick) actions_.pop_front();
}

void Replay::NoteAction(std::int64_t tick, int player, int action) {
  if (config_.resimulates) actions_.push_back({tick, player, action});
}

void Replay::Forget() {
  barriers_.clear();
  from_ = -1;
}

/// By mechanism: whether it touches bodies of other authorities, without a blow since `from`.
void Replay::FindPressed(std::int64_t from) {
  pressed_.clear();
  for (std::size_t m = 0; m < world_.composition().mechanisms.size(); ++m) {
    pressed_.push_back(memory_.Coupled(static_cast<int>(m)));
  }
  for (int body = 0; body < world_.body_count(); ++body) {
    if (memory_.track(body).last_impact_tick < from &&
        world_.Read(body).velocity.norm() < kPressedSpeed) {
      continue;
    }
    pressed_[static_cast<std::size_t>(world_.mechanism(body))] = false;
  }
}

/// Whether the body goes again where it went: it was not stepped here then, or is held to what was
/// told of it.
bool Replay::FollowsHistory(int body, std::int64_t tick) const {
  if (!roles_.Simulates(body)) return true;
  if (memory_.track(body).at_rest) return true;  // committed, here too
  if (tick <= memory_.track(body).dynamic_since) return true;
  if (roles_.RoleOfBody(body) != kRoleAuthority) return false;
  // What was told of a body at rest is bit for bit where it lies.
  return pressed_[static_cast<std::size_t>(world_.mechanism(body))] || !world_.awake(body);
}

/// After the step to the world's tick: what is known of it.
void Replay::PutIn() {
  for (int body = 0; body < world_.body_count(); ++body) {
    BodyState* past = memory_.history().At(world_.tick(), body);
    if (FollowsHistory(body, world_.tick())) {
      world_.Write(body, *past, false);
      continue;
    }
    const BodyState local = world_.Read(body);
    const BodyState* heard = memory_.snapshots().At(body, world_.tick());
    if (heard != nullptr && roles_.RoleOfBody(body) == kRoleSecondary) {
      BodyState state = *heard;
      state.angle = UnwrapAngle(state.angle, local.angle);
      const bool moves = state.velocity.squaredNorm() > 0 || state.spin != 0;
      const bool pressed = pressed_[static_cast<std::size_t>(world_.mechanism(body))];
      state = PlusScaled(local, Minus(state, local), pressed ? kPressedShare : 1.0f);
      if (!Negligible(Minus(state, local))) {
        world_.Write(body, WithinLimits(state, world_.scene().speed_limit), moves);
      }
    }
    *past = world_.Read(body);
  }
}

void Replay::StepAgain() {
  const std::int64_t next = world_.tick() + 1;
  for (std::size_t p = 0; p < inputs_.size(); ++p) {
    world_.SetInput(static_cast<int>(p), inputs_[p].At(next));
  }
  for (int body = 0; body < world_.body_count(); ++body) {
    if (world_.motion(body) != Motion::kKinematic) continue;
    BodyState state = *memory_.history().At(world_.tick(), body);
    const BodyState& after = *memory_.history().At(next, body);
    state.velocity = (after.position - state.position) / world_.dt();
    state.spin = (after.angle - state.angle) / world_.dt();
    world_.Write(body, WithinLimits(state, world_.scene().speed_limit), state.velocity.norm() > 0);
  }
  for (const Action& act : actions_) {
    if (act.tick == next) world_.Act(act.player, act.action);
  }
  world_.Step();
}

void Replay::Run() {
  if (from_ < 0) return;
  const std::int64_t from = std::exchange(from_, -1);
  const std::int64_t now = world_.tick();
  while (!barriers_.empty() && barriers_.back().tick > from) barriers_.pop_back();
  if (barriers_.empty()) return;
  std::vector<BodyState> shown;
  std::vector<bool> was_awake;
  for (int body = 0; body < world_.body_count(); ++body) {
    shown.push_back(world_.Read(body));
    was_awake.push_back(world_.awake(body));
  }
  FindPressed(from);
  if (!world_.Restore(barriers_.back()).ok()) return Forget();  // edited since
  PutIn();
  while (world_.tick() < now) {
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
    display_.Moved(body, Minus(world_.Read(body), shown[b]));
  }
}

}  // namespace seam
