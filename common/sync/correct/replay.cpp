#include "common/sync/correct/replay.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "common/base/geometry.h"
#include "common/sync/correct/presses.h"
#include "common/sync/rest/rest_disturbed.h"
#include "common/sync/state_limits.h"

namespace seam {
namespace {

/// Most that is stepped again, s. At 200 ms one way, an input is known elsewhere after 0.4 s, and
/// the state of the tick that it completed another 0.4 s later. Less than the history.
constexpr int kReplayMax = 2;
/// Who is alone goes back for edits, which are rare: from a barrier in 1/4 s.
constexpr int kAlonePart = 4;
/// Of the difference, where bodies of several authorities press against each other. All of it
/// doubles the error of a shoved stack; much less is no longer a correction.
constexpr float kPressedShare = 0.3f;
/// What moves faster than this, m/s, or was struck, does not count as pressed.
constexpr float kPressedSpeed = 2;
/// Budget: ticks stepped again for each tick, in the long run, and how many may be saved up.
constexpr double kAgainPerTick = 4, kAgainSaved = 240;
/// With the same inputs both sides come to nearly the same. Up to these differences it stays: half
/// a quantum came from the wire, and writing it would set both sides on slightly other ways again.
constexpr float kAgreesPosition = 4 * kPositionQuantum;     // m
constexpr float kAgreesVelocity = 16 * kVelocityQuantum;    // m/s
constexpr float kAgreesAngle = 0.005f, kAgreesSpin = 0.1f;  // rad, rad/s

/// From `then` to `now`. Whole turns are no difference: two peers may have counted them otherwise.
BodyState Apart(const BodyState& now, const BodyState& then) {
  BodyState apart = Minus(now, then);
  apart.angle = WrapAngle(apart.angle);
  return apart;
}

/// Back at a barrier: what already rested then lies where its authority has said since, and not
/// where this peer had it, or every replay would bring that back and end its rest. Only where
/// inputs are stamped: the other rules put what rests there in every tick (FollowsHistory), once
/// they have looked whether it was struck (EndRest), which must not be hidden from them.
void PutToRest(World& world, const Roles& roles, BodyMemory& memory) {
  for (int body = 0; body < world.body_count(); ++body) {
    const BodyTrack& track = memory.track(body);
    if (!track.at_rest || roles.RoleOfBody(body) != kRoleSecondary) continue;
    if (world.motion(body) == Motion::kAbsent || world.tick() < track.heard_tick) continue;
    const BodyState* const lay = memory.history().At(world.tick(), body);
    if (lay == nullptr || Negligible(Apart(world.Read(body), *lay))) continue;
    world.Write(body, *lay, false);
    world.SetAwake(body, false);
  }
}

}  // namespace

Replay::Replay(const SyncConfig& config, World& world, const Roles& roles, const Drivers& drivers,
               BodyMemory& memory, Display& display, const std::vector<InputTrack>& inputs)
    : config_(config),
      world_(world),
      roles_(roles),
      drivers_(drivers),
      memory_(memory),
      display_(display),
      inputs_(inputs) {
  NoteSitters();
}

bool Replay::Agrees(const BodyState& d) const {
  if (Negligible(d)) return true;
  return config_.StampsInputs(roles_.self()) && d.position.norm() < kAgreesPosition &&
         d.velocity.norm() < kAgreesVelocity && std::fabs(d.angle) < kAgreesAngle &&
         std::fabs(d.spin) < kAgreesSpin;
}

bool Replay::Ask(int body, std::int64_t tick) {
  if (IsBeforeEdit(tick)) return true;
  if (barriers_.empty() || tick < barriers_.front().world.tick) return false;
  if (tick < memory_.track(body).dynamic_since) return BeginsEarlier(body, tick);
  const BodyState* known = memory_.snapshots().At(body, tick);
  if (known == nullptr) return true;  // a newer one was there before this
  const BodyState& then = *memory_.history().At(tick, body);
  BodyState heard = *known;
  heard.angle = UnwrapAngle(heard.angle, then.angle);
  if (!Agrees(Minus(heard, then))) AskFrom(tick);
  return true;
}

/// A state from before the copy was simulated: it is simulated from there on, so that what was
/// under way when it began to be is not lost.
bool Replay::BeginsEarlier(int body, std::int64_t tick) {
  if (!config_.StampsInputs(roles_.self())) return false;
  const BodyState* known = memory_.snapshots().At(body, tick);
  BodyState* past = memory_.history().At(tick, body);
  if (known == nullptr || past == nullptr) return false;
  BodyState heard = *known;
  heard.angle = UnwrapAngle(heard.angle, past->angle);
  *past = heard;
  memory_.track(body).dynamic_since = tick;
  AskFrom(tick);
  return true;
}

void Replay::AskFrom(std::int64_t tick) {
  if (barriers_.empty()) return;
  tick = std::max(tick, barriers_.front().world.tick);
  if (tick >= world_.tick()) return;
  if (from_ < 0 || tick < from_) from_ = tick;
}

bool Replay::IsAlone() const {
  const std::vector<int>& players = drivers_.concerned();
  const auto other = [this](int player) { return player != roles_.own_player(); };
  return std::none_of(players.begin(), players.end(), other) && !roles_.Shares();
}

void Replay::TakeBarrier() {
  if (!config_.TakesBarriers(roles_.self()) || world_.tick() % config_.send_every() != 0) return;
  // What has fallen asleep is built anew once as it lies.
  const bool is_alone = IsAlone(), alone = std::exchange(was_alone_, is_alone) && is_alone;
  const std::int64_t every = alone ? config_.tick_hz / kAlonePart : 0;
  if (!barriers_.empty() && world_.tick() - barriers_.back().world.tick < every) return;
  AddBarrier(alone);
  while (barriers_.front().world.tick < world_.tick() - kReplayMax * config_.tick_hz) {
    barriers_.pop_front();
  }
  while (edits_before_ < barriers_.front().edits) {
    edits_.pop_front();
    ++edits_before_;
  }
  while (!actions_.empty() && actions_.front().tick < barriers_.front().world.tick)
    actions_.pop_front();
}

void Replay::NoteAction(std::int64_t tick, int player, int action) {
  const int self = roles_.self();
  if (config_.GoesBack(self) && !config_.StampsInputs(self)) {
    actions_.push_back({tick, player, action});
  }
}

void Replay::Forget() {
  DropBarriers();
  from_ = -1;
}

/// By mechanism: whether it touches bodies of other authorities, without a blow since `from`.
void Replay::FindPressed(std::int64_t from) {
  pressed_.assign(world_.composition().mechanisms.size(), false);
  if (config_.StampsInputs(roles_.self())) return;
  for (std::size_t m = 0; m < pressed_.size(); ++m) {
    pressed_[m] = memory_.Coupled(static_cast<int>(m));
  }
  for (const int body : world_.present()) {
    if (memory_.track(body).last_impact_tick < from &&
        world_.Read(body).velocity.norm() < kPressedSpeed) {
      continue;
    }
    pressed_[static_cast<std::size_t>(world_.mechanism(body))] = false;
  }
}

/// Whether others were told where the body of ours was then, or later, and no input can change it.
/// If all agree it goes there again by itself. Where they do not (one was cut off, say) each would
/// go back for what the other has told, make its own go another way than it has told, and the other
/// go back for that: in a room full of blows they never agreed again, and won energy with each blow
/// that only one of two had. Only where nobody's inputs move anything: elsewhere what is told now
/// and then turns out wrong, and to revise it is what brings all to the same (docs/lessons.md).
bool Replay::IsFact(int body, std::int64_t tick) const {
  if (tick > memory_.track(body).told_tick || !drivers_.concerned().empty()) return false;
  return roles_.RoleOfBody(body) == kRoleAuthority;
}

/// Whether the body goes again where it went: it was not stepped here then, or is held to what was
/// told of it.
bool Replay::FollowsHistory(int body, std::int64_t tick) const {
  if (!roles_.Simulates(body)) return true;
  if (memory_.track(body).at_rest && !config_.StampsInputs(roles_.self())) return true;
  if (tick <= memory_.track(body).dynamic_since) return true;
  if (IsFact(body, tick)) return true;
  if (roles_.RoleOfBody(body) != kRoleAuthority) return false;
  if (config_.StampsInputs(roles_.self())) return false;
  // What was told of a body at rest is bit for bit where it lies.
  return pressed_[static_cast<std::size_t>(world_.mechanism(body))] || !world_.awake(body);
}

/// Where inputs are stamped, what is committed to rest is stepped again, and rests on if it has
/// come to rest again where it lay.
bool Replay::RestsAsBefore(int body, const BodyState& pose) {
  BodyTrack& track = memory_.track(body);
  if (!track.at_rest) return false;
  track.at_rest = !world_.awake(body) && Agrees(Apart(world_.Read(body), pose));
  return track.at_rest;
}

/// What turns out to have been disturbed rests no more.
void Replay::EndRest() {
  if (config_.StampsInputs(roles_.self())) return;  // it is stepped again like anything else
  for (const int body : DisturbedRest(world_, drivers_, memory_, inputs_)) {
    const bool held = world_.tick() <= memory_.track(body).dynamic_since;
    if (roles_.Simulates(body) && !held) memory_.track(body).at_rest = false;
  }
}

/// After the step to the world's tick: what is known of it.
void Replay::PutIn() {
  EndRest();
  for (const int body : world_.present()) PutIn(body);  // what is absent stays until Arrive
}

void Replay::PutIn(int body) {
  BodyState* past = memory_.history().At(world_.tick(), body);
  if (FollowsHistory(body, world_.tick())) {
    // What woke it then may not have come this time: it moves on from there all the same.
    const bool moved = past->velocity.squaredNorm() > 0 || past->spin != 0;
    world_.Write(body, *past, moved && IsFact(body, world_.tick()));
    return;
  }
  const BodyState* heard = memory_.snapshots().At(body, world_.tick());
  if (heard != nullptr && roles_.RoleOfBody(body) == kRoleSecondary) {
    const BodyState local = world_.Read(body);
    BodyState state = *heard;
    state.angle = UnwrapAngle(state.angle, local.angle);
    const bool moves = state.velocity.squaredNorm() > 0 || state.spin != 0;
    const bool pressed = pressed_[static_cast<std::size_t>(world_.mechanism(body))];
    state = PlusScaled(local, Minus(state, local), pressed ? kPressedShare : 1.0f);
    if (!Agrees(Minus(state, local))) {
      world_.Write(body, WithinLimits(state, world_.scene().speed_limit), moves);
    }
  }
  *past = world_.Read(body);
}

/// Buttons: as they are stamped, or as this peer acted on them.
void Replay::ActAgain(std::int64_t next) {
  for (const Action& act : actions_) {
    if (act.tick == next) world_.Act(act.player, act.action);
  }
  if (!config_.StampsInputs(roles_.self())) return;
  for (const int player : drivers_.concerned()) {
    const InputTrack& track = inputs_[static_cast<std::size_t>(player)];
    EachAction(world_, player, track.PressedAt(next), [&](int action, int mechanism) {
      if (roles_.RoleOf(mechanism) != kRoleRemote) world_.Act(player, action);
    });
  }
}

void Replay::StepAgain() {
  const std::int64_t next = world_.tick() + 1;
  for (const int player : drivers_.concerned()) {
    world_.SetInput(player, inputs_[static_cast<std::size_t>(player)].At(next));
  }
  for (const int body : world_.present()) {
    if (world_.motion(body) == Motion::kDynamic) continue;
    // Paths that are displayed jump from message to message: what hits others is the velocity that
    // was displayed, not that of a jump.
    const BodyState& after = *memory_.history().At(next, body);
    BodyState before = after;
    before.position -= world_.dt() * after.velocity;
    before.angle -= world_.dt() * after.spin;
    const bool moves = after.velocity.squaredNorm() > 0 || after.spin != 0;
    world_.Write(body, WithinLimits(before, world_.scene().speed_limit), moves);
  }
  ActAgain(next);
  world_.Step();
  ++stepped_again_;
  on_stepped_again_();
}

void Replay::Run() {
  credit_ = std::min(kAgainSaved, credit_ + kAgainPerTick);
  if (from_ < 0) return;
  if (credit_ <= 0) {
    ++deferred_;
    return;
  }
  const std::int64_t now = world_.tick();
  if (!Depart(std::exchange(from_, -1), false)) return;
  StepTo(now);
  Arrive();
}

/// Goes back to the newest barrier that is not after `from`. `all`: bodies may become others on the
/// way, so that each counts; else what is absent and lies as it did then stays where it is.
bool Replay::Depart(std::int64_t from, bool all) {
  while (!barriers_.empty() && barriers_.back().world.tick > from) barriers_.pop_back();
  if (barriers_.empty()) return false;
  Journey journey;
  journey.from = from;
  journey.now = world_.tick();
  std::vector<int> bodies = world_.ApartFrom(barriers_.back().world);
  if (all) {
    bodies.resize(static_cast<std::size_t>(world_.body_count()));
    std::iota(bodies.begin(), bodies.end(), 0);
  }
  for (const int body : bodies) {
    journey.shown.push_back({body, world_.Read(body), world_.awake(body)});
  }
  FindPressed(from);
  UndoEdits();
  if (!world_.Restore(barriers_.back().world).ok()) {  // edited since
    Forget();
    return false;
  }
  journey_ = std::move(journey);
  credit_ -= static_cast<double>(journey_->now - world_.tick());
  PutIdle();
  if (config_.StampsInputs(roles_.self())) PutToRest(world_, roles_, memory_);
  PutIn();
  RepeatEdits();
  return true;
}

/// What nothing could touch lay then where it lies now: without its surroundings it would go astray
/// from a tick at which it had not quite come to rest.
void Replay::PutIdle() {
  for (const Shown& shown : journey_->shown) {
    if (!memory_.track(shown.body).idle) continue;
    world_.Write(shown.body, shown.state, false);
    world_.SetAwake(shown.body, false);
  }
}

void Replay::StepTo(std::int64_t tick) {
  while (world_.tick() < tick) {
    StepAgain();
    PutIn();
    TakeBarrier();
    RepeatEdits();
  }
}

/// At now again: what is only displayed is where it was, and the view of the rest stays there.
void Replay::Arrive() {
  for (const Shown& shown : journey_->shown) {
    const int body = shown.body;
    if (FollowsHistory(body, journey_->now) || RestsAsBefore(body, shown.state)) {
      world_.Write(body, shown.state, shown.awake && IsFact(body, journey_->now));
      if (!shown.awake) world_.SetAwake(body, false);
    }
    display_.Moved(body, Apart(world_.Read(body), shown.state));
  }
  journey_.reset();
}

}  // namespace seam
