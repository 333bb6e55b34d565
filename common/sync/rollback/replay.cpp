#include "common/sync/rollback/replay.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "common/base/geometry.h"
#include "common/sync/rollback/presses.h"
#include "common/sync/state_limits.h"

namespace seam {
namespace {

/// A peer that is alone rolls back only for edits, which are rare: one barrier in 1/4 s.
constexpr int kAlonePart = 4;
/// Budget: ticks of replay per tick in the long run, and the most that may be saved up.
constexpr double kAgainPerTick = 4, kAgainSaved = 240;
/// With the same inputs both sides reach nearly the same result. Differences up to these are left:
/// the wire adds half a quantum, and writing it would make both sides diverge slightly again.
constexpr float kAgreesPosition = 4 * kPositionQuantum;     // m
constexpr float kAgreesVelocity = 16 * kVelocityQuantum;    // m/s
constexpr float kAgreesAngle = 0.005f, kAgreesSpin = 0.1f;  // rad, rad/s

/// Returns the difference from `then` to `now`, without whole turns: peers may count them
/// differently.
BodyState Apart(const BodyState& now, const BodyState& then) {
  BodyState apart = Minus(now, then);
  apart.angle = WrapAngle(apart.angle);
  return apart;
}

/// Puts a copy that rested at the world's tick exactly where its authority has committed it since;
/// otherwise each replay would restore our old pose and end the rest.
void PutToRest(int body, World& world, const BodyMemory& memory) {
  const BodyState* const lay = memory.history().At(world.tick(), body);
  if (lay == nullptr || (!world.awake(body) && SamePose(world.Read(body), *lay))) return;
  world.Write(body, *lay, false);
  world.SetAwake(body, false);
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
  RecordSeats();
}

bool Replay::Agrees(const BodyState& d) {
  if (Negligible(d)) return true;
  return d.position.norm() < kAgreesPosition && d.velocity.norm() < kAgreesVelocity &&
         std::fabs(d.angle) < kAgreesAngle && std::fabs(d.spin) < kAgreesSpin;
}

bool Replay::Ask(int body, std::int64_t tick) {
  if (IsBeforeEdit(tick)) {
    if (HeardOtherwise(body, tick)) missed_ = std::max(missed_, oldest());
    return true;
  }
  if (barriers_.empty() || tick < barriers_.front().world->tick) return false;
  if (tick < memory_.track(body).dynamic_since) return SimulateFrom(body, tick);
  if (HeardOtherwise(body, tick)) AskFrom(tick);
  return true;
}

bool Replay::HeardOtherwise(int body, std::int64_t tick) const {
  const BodyState* const known = memory_.snapshots().At(body, tick);
  const BodyState* const then = memory_.history().At(tick, body);
  if (known == nullptr || then == nullptr) return false;  // replaced by a newer one earlier
  BodyState heard = *known;
  heard.angle = UnwrapAngle(heard.angle, then->angle);
  return !Agrees(Minus(heard, *then));
}

/// Begins the simulation of a copy at a state from before it was simulated, so that its motion at
/// that time is not lost.
bool Replay::SimulateFrom(int body, std::int64_t tick) {
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
  if (tick < oldest()) missed_ = std::max(missed_, oldest());
  tick = std::max(tick, oldest());
  if (tick >= world_.tick()) return;
  if (from_ < 0 || tick < from_) from_ = tick;
}

bool Replay::IsAlone() const {
  const std::vector<int>& players = drivers_.concerned();
  const auto other = [this](int player) { return player != roles_.own_player(); };
  return std::none_of(players.begin(), players.end(), other) && !roles_.Shares();
}

void Replay::TakeBarrier() {
  const bool due = world_.tick() % BarrierEvery(config_.tick_hz) == 0;
  if (!due || !config_.policy->TakesBarriers(roles_.self())) return;
  // A body that has just fallen asleep is rebuilt once as it lies.
  const bool is_alone = IsAlone(), alone = std::exchange(was_alone_, is_alone) && is_alone;
  const std::int64_t every = alone ? config_.tick_hz / kAlonePart : 0;
  if (!barriers_.empty() && world_.tick() - barriers_.back().world->tick < every) return;
  AddBarrier(alone);
  while (barriers_.front().world->tick < world_.tick() - kReplayMax * config_.tick_hz) {
    barriers_.pop_front();
  }
  while (edits_before_ < barriers_.front().edits) {
    edits_.pop_front();
    ++edits_before_;
  }
}

void Replay::Forget() {
  DropBarriers();
  from_ = -1;
}

/// True if this own body's state of that tick or later was sent and no input can change it. If all
/// peers agree, a replay reaches it again by itself. If they do not (after a cut, say), each peer
/// would roll back for the other's state, send its own body along another path than announced, and
/// make the other roll back in turn: a room full of impacts never agreed again and gained energy
/// from every impact that only one of two peers had. Applies only where no inputs move anything.
/// Elsewhere a sent state may prove wrong, and revising it makes all peers agree (docs/lessons.md).
bool Replay::IsFact(int body, std::int64_t tick) const {
  if (tick > memory_.track(body).told_tick || !drivers_.concerned().empty()) return false;
  return roles_.RoleOfBody(body) == kRoleAuthority;
}

/// True if the body repeats its history: it was not simulated here then, or is held to states
/// already sent.
bool Replay::FollowsHistory(int body, std::int64_t tick) const {
  if (!roles_.Simulates(body)) return true;
  return tick <= memory_.track(body).dynamic_since || IsFact(body, tick);
}

/// Ends a committed rest that a replay has changed. Committed bodies are stepped again; the rest
/// holds only if the body lies at exactly the same pose: another one, however near, is that of all
/// who know the same inputs. Returns true if it holds.
bool Replay::KeepsRest(int body, const BodyState& pose) {
  BodyTrack& track = memory_.track(body);
  if (!track.at_rest) return false;
  track.at_rest = !world_.awake(body) && SamePose(world_.Read(body), pose);
  return track.at_rest;
}

/// True if the body is a copy held at the pose that its authority committed.
bool Replay::RestsAsCopy(int body) const {
  return memory_.track(body).at_rest && roles_.RoleOfBody(body) == kRoleSecondary;
}

/// Call after the step to the world's tick. Writes the states known of that tick.
void Replay::WriteKnownStates() {
  for (const int body : world_.present()) WriteKnownStates(body);  // others wait for Arrive
}

void Replay::WriteKnownStates(int body) {
  BodyState* past = memory_.history().At(world_.tick(), body);
  if (FollowsHistory(body, world_.tick())) {
    // The cause that woke it then may be missing this time; it moves on all the same.
    const bool moved = past->velocity.squaredNorm() > 0 || past->spin != 0;
    world_.Write(body, *past, moved && IsFact(body, world_.tick()));
    return;
  }
  const BodyState* heard = memory_.snapshots().At(body, world_.tick());
  if (heard != nullptr && roles_.RoleOfBody(body) == kRoleSecondary) {
    // The commitment itself. A newer state, or an edit of an earlier tick, would have replaced it.
    if (RestsAsCopy(body) && memory_.track(body).heard_tick == world_.tick() &&
        SamePose(*heard, *past)) {
      PutToRest(body, world_, memory_);
      return;
    }
    const BodyState local = world_.Read(body);
    BodyState state = *heard;
    state.angle = UnwrapAngle(state.angle, local.angle);
    const bool moves = state.velocity.squaredNorm() > 0 || state.spin != 0;
    // Rounds as all corrections do, which add a difference.
    state = PlusScaled(local, Minus(state, local), 1);
    if (!Agrees(Minus(state, local))) {
      memory_.NoteDiffering(world_.mechanism(body));  // by all inputs known by now
      world_.Write(body, WithinLimits(state, world_.scene().speed_limit), moves);
      display_.MovedInPast(body, Apart(world_.Read(body), local));
    }
  }
  *past = world_.Read(body);
}

/// Repeats button actions at their ticks.
void Replay::ActAgain(std::int64_t next) {
  for (const int player : drivers_.concerned()) {
    const InputTrack& track = inputs_[static_cast<std::size_t>(player)];
    EachAction(world_, player, track.PressedAt(next), [&](int action, int mechanism) {
      if (roles_.RoleOf(mechanism) != kRoleRemote) world_.Act(player, action);
    });
  }
}

void Replay::ReplayTick() {
  const std::int64_t next = world_.tick() + 1;
  for (const int player : drivers_.concerned()) {
    world_.SetInput(player, inputs_[static_cast<std::size_t>(player)].At(next));
  }
  for (const int body : world_.present()) {
    if (world_.activity(body) == Activity::kSimulated) continue;
    // Displayed paths jump from message to message. Others must be hit at the velocity displayed,
    // not at that of a jump.
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

/// Goes back to the newest barrier that is not after `from`. `all`: edits may recreate bodies on
/// the way, so every body is remembered; else those that are not present and have not changed stay.
bool Replay::Depart(std::int64_t from, bool all) {
  while (!barriers_.empty() && barriers_.back().world->tick > from) barriers_.pop_back();
  if (barriers_.empty()) return false;
  Journey journey;
  journey.now = world_.tick();
  std::vector<int> bodies = world_.MayDifferFrom(*barriers_.back().world);
  if (all) {
    bodies.resize(static_cast<std::size_t>(world_.body_count()));
    std::iota(bodies.begin(), bodies.end(), 0);
  }
  for (const int body : bodies) {
    journey.shown.push_back({body, world_.Read(body), world_.awake(body)});
  }
  UndoEdits();
  if (!world_.Restore(*barriers_.back().world).ok()) {  // edited since
    Forget();
    return false;
  }
  journey_ = std::move(journey);
  credit_ -= static_cast<double>(journey_->now - world_.tick());
  display_.ReplayedFrom(world_.tick());
  RestoreDormant();
  for (const int body : world_.present()) {
    if (RestsAsCopy(body) && world_.tick() >= memory_.track(body).heard_tick) {
      PutToRest(body, world_, memory_);
    }
  }
  WriteKnownStates();
  RepeatEdits();
  return true;
}

/// Puts dormant bodies where they are now: nothing could touch them. Without their surroundings,
/// bodies not yet at rest at that tick would drift away.
void Replay::RestoreDormant() {
  for (const Shown& shown : journey_->shown) {
    if (world_.activity(shown.body) != Activity::kDormant) continue;
    world_.Write(shown.body, shown.state, false);
    world_.SetAwake(shown.body, false);
  }
}

void Replay::StepTo(std::int64_t tick) {
  while (world_.tick() < tick) {
    ReplayTick();
    WriteKnownStates();
    TakeBarrier();
    RepeatEdits();
  }
}

/// Ends the replay: displayed bodies return to their states, and the views of the rest stay put.
void Replay::Arrive() {
  for (const Shown& shown : journey_->shown) {
    const int body = shown.body;
    if (FollowsHistory(body, journey_->now) || KeepsRest(body, shown.state)) {
      world_.Write(body, shown.state, shown.awake && IsFact(body, journey_->now));
      if (!shown.awake) world_.SetAwake(body, false);
    }
    display_.Moved(body, Apart(world_.Read(body), shown.state));
  }
  journey_.reset();
}

}  // namespace seam
