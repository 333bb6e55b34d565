#include "common/sync/rest/rest_commit.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/codec/persist_message.h"
#include "common/sync/rest/rest_islands.h"
#include "common/sync/state_arithmetic.h"
#include "common/sync/state_limits.h"

namespace seam {
namespace {

/// A woken copy goes back to rest if its authority has not reported motion for this long, s: more
/// than two round trips of a slow path, because the input has to reach the authority first, and the
/// state takes as long again.
constexpr double kBackAfter = 2;

/// Rewrites our past of the body: it has rested since the commitment, whatever this peer assumed.
void WriteHistory(const RestRecord& rest, std::int64_t now, int body, BodyMemory* memory) {
  std::int64_t tick = std::max(rest.tick, memory->history().oldest());
  for (; tick <= now; ++tick) {
    if (BodyState* past = memory->history().At(tick, body)) *past = rest.pose;
  }
}

}  // namespace

RestCommit::RestCommit(const SyncConfig& config, World& world, const Roles& roles,
                       BodyMemory& memory, Display& display, const Reach& reach)
    : config_(config),
      world_(world),
      roles_(roles),
      memory_(memory),
      display_(display),
      reach_(reach),
      table_(memory.table()),
      watch_(world, memory.table()),
      disturbed_(memory.table(), BodyRule::kSame),
      after_edit_(memory.table(), [this](const BodyRemap&) { FindHeld(); }) {}

std::int64_t RestCommit::Ticks(double seconds) const {
  return static_cast<std::int64_t>(seconds * config_.tick_hz);
}

/// Ends a commitment when a newer state was heard: the authority sends no states of resting bodies.
void RestCommit::EndOutdated(int body) {
  const RestRecord& record = table_.at(body);
  if (!record.committed) return;
  const bool own = Own(body);
  if (own ? Holds(body) : memory_.track(body).heard_tick <= record.tick) return;
  table_.End(body);
  memory_.track(body).at_rest = false;
  disturbed(body) = Disturbance{};
}

void RestCommit::Put(int body) {
  const BodyState& pose = table_.at(body).pose;
  const BodyState now = world_.Read(body);
  const bool lies = now.position == pose.position && now.angle == pose.angle &&
                    now.velocity == pose.velocity && now.spin == pose.spin;
  if (lies && !world_.awake(body)) return;
  BodyState moved = Minus(pose, now);
  moved.angle = WrapAngle(moved.angle);  // whole turns are invisible
  moved.velocity.setZero();
  moved.spin = 0;
  if (!Negligible(moved)) display_.Moved(body, moved);
  world_.Write(body, pose, false);
  if (world_.awake(body)) world_.SetAwake(body, false);
}

void RestCommit::PutBack() {
  if (Off() || edited_) return;              // an edit's push must not be lost
  for (const int body : memory_.unparked()) {  // a parked body is at rest already
    if (Holds(body)) Put(body);
  }
}

void RestCommit::LetGo(int body) {
  memory_.track(body).at_rest = false;
  if (Own(body)) {
    table_.End(body);
    disturbed(body).pushed_ticks = 0;
  } else {
    disturbed(body).released_tick = world_.tick();
    freed_.push_back(body);
  }
}

/// Chooses the bodies to check. Bodies that are not present count only if heard of, moved or freed,
/// which may now be long enough ago.
void RestCommit::FindDue() {
  due_.clear();
  const auto add_others = [this](const std::vector<int>& bodies) {
    for (const int body : bodies) {
      if (!IsPresent(world_.activity(body))) due_.push_back(body);
    }
  };
  add_others(memory_.news());
  add_others(freed_);
  if (edited_) add_others(memory_.unparked());
  freed_.erase(std::remove_if(freed_.begin(), freed_.end(),
                              [this](int body) { return disturbed(body).released_tick < 0; }),
               freed_.end());
  std::sort(due_.begin(), due_.end());
  due_.erase(std::unique(due_.begin(), due_.end()), due_.end());
  due_.insert(due_.begin(), world_.present().begin(), world_.present().end());
}

void RestCommit::BeforeStep() {
  if (Off()) return;
  Prepare();
  FindDue();
  for (const int body : due_) {
    EndOutdated(body);
    Hold(body);
  }
  edited_ = false;
}

void RestCommit::Hold(int body) {
  const std::int64_t back_after = Ticks(BackAfter());
  Disturbance& d = disturbed(body);
  if (d.released_tick >= 0 && world_.tick() - d.released_tick >= back_after) {
    d.released_tick = -1;
    memory_.track(body).at_rest = table_.at(body).committed;
    if (Holds(body)) {
      WriteHistory(table_.at(body), world_.tick(), body, &memory_);
      Put(body);
    }
  }
  if (!Holds(body) && table_.at(body).committed && d.released_tick < 0) {
    LetGo(body);  // a replay found an impact
  }
  if (!Holds(body)) return;
  // A displayed body is awake here only if the edit woke it. Its rest ends, as at every peer: it
  // may become this peer's own before its authority has spoken.
  const bool simulated = world_.activity(body) == Activity::kSimulated;
  if (world_.awake(body) && (edited_ || (simulated && IsDisturbed(body)))) {
    LetGo(body);
  } else {
    Put(body);
  }
}

double RestCommit::BackAfter() const { return kBackAfter; }

void RestCommit::HoldIsland(const std::vector<int>& island) {
  for (const int body : island) {
    if (!Holds(body) || !world_.awake(body)) continue;
    world_.activity(body) == Activity::kSimulated ? LetGo(body) : Put(body);
  }
}

void RestCommit::AfterStep() {
  if (Off()) return;
  bool woken = false, open = false;
  for (const int body : world_.present()) {  // another is displayed or dormant
    woken = woken || (Holds(body) && world_.awake(body));
    open = open || (!Holds(body) && Own(body));
    const bool anew = Own(body) && Holds(body) &&
                      table_.at(body).epoch != roles_.table().at(world_.mechanism(body)).epoch;
    if (anew && !world_.awake(body)) Commit(body);  // taken over from another peer
  }
  if (woken) {
    for (const std::vector<int>& island : FindPresentIslands(world_)) HoldIsland(island);
  }
  watch_.Look();
  if (open && world_.tick() % BarrierEvery(config_.tick_hz) == 0) {
    // A body that this peer may still commit is always present.
    for (const std::vector<int>& island : FindPresentIslands(world_)) CommitIsland(island);
  }
  std::vector<Rest> waiting;
  waiting.swap(waiting_);
  for (const Rest& rest : waiting) Receive(rest);
}

void RestCommit::FindHeld() {
  freed_.clear();
  for (int body = 0; body < world_.body_count(); ++body) {
    const bool released = disturbed(body).released_tick >= 0;
    memory_.track(body).at_rest = table_.at(body).committed && !released;
    if (released) freed_.push_back(body);
  }
  watch_.StartAnew();
  committed_.clear();
}

void RestCommit::StartAnew() {
  table_.Clear();
  watch_.StartAnew();
  disturbed_.Reset();
  freed_.clear();
  for (int body = 0; body < world_.body_count(); ++body) memory_.track(body).at_rest = false;
  committed_.clear();
  waiting_.clear();
}

bool RestCommit::all() const {
  if (Off()) return false;
  // Starts with the body found last: it is probably still not held.
  const int count = world_.body_count();
  if (open_ < count && !Holds(open_)) return false;
  for (open_ = 0; open_ < count; ++open_) {
    if (!Holds(open_)) return false;
  }
  return true;
}

void RestCommit::Persist(StateArchive& a) {
  table_.Persist(a, world_);
  watch_.Persist(a);
  a.Exactly(&disturbed_, [&](Disturbance* d) {
    a.Tick(&d->released_tick);
    a.Int(&d->pushed_ticks, 0, StateArchive::kCountMost);
    a.Int(&d->times, 0, StateArchive::kCountMost);
  });
  a.Flag(&edited_);
  a.Int(&number_, 0, StateArchive::kTickMost * kIdsMax / 2);
  a.List(&waiting_, kEarlyMessagesMax,
         [&](Rest* rest) { PersistMessage(a, rest, kBusMessageBytesMax); });
  if (!a.reading()) return;
  freed_.clear();
  for (int body = 0; body < world_.body_count(); ++body) {
    if (disturbed(body).released_tick >= 0) freed_.push_back(body);
    a.Require(!Holds(body) || table_.at(body).committed, "a body is held at no pose");
  }
}

}  // namespace seam
