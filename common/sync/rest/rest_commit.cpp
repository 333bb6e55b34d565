#include "common/sync/rest/rest_commit.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/sync/reconcile/reconcile.h"
#include "common/sync/rest/rest_islands.h"
#include "common/sync/state_limits.h"

namespace seam {
namespace {

/// The engine's sleep thresholds, m/s and rad/s, and the factor above them that wakes a committed
/// body.
constexpr float kSleepSpeed = 0.01f, kSleepSpin = 0.035f, kWakeShare = 1.4f;
/// ...if exceeded for this long in a row, s: a corrected copy next to it pushes only for a tick or
/// two. The time doubles with each release, at most kWaitDoublings times: two peers whose copies
/// lie differently would otherwise wake each other forever.
constexpr double kPushedFor = 0.1;
constexpr int kWaitDoublings = 5;
/// An impact, m/s and rad/s: wakes the body at once.
constexpr float kWakeImpactSpeed = 0.5f;
/// A woken copy goes back to rest if its authority has not reported motion for this long, s: more
/// than the round trip of a slow path. Where states are sent only for input-complete ticks, the
/// input has to reach the authority first, and the state takes as long again.
constexpr double kBackAfter = 0.75, kBackAfterTrusted = 2;

/// By mechanism: true if a player whose axes move it, or who owns it, gives any input in this tick.
/// `inputs`: by player.
std::vector<bool> DrivenIn(const World& world, const Drivers& drivers,
                           const std::vector<InputTrack>& inputs, std::int64_t tick) {
  std::vector<bool> driven(world.composition().mechanisms.size(), false);
  for (std::size_t p = 0; p < inputs.size(); ++p) {
    if (inputs[p].At(tick) == Input{}) continue;
    for (const int m : drivers.MovedBy(static_cast<int>(p)))
      driven[static_cast<std::size_t>(m)] = true;
  }
  return driven;
}

/// Rewrites our past of the body: it has rested since the commitment, whatever this peer assumed.
void WriteHistory(const RestRecord& rest, std::int64_t now, int body, BodyMemory* memory) {
  std::int64_t tick = std::max(rest.tick, memory->history().oldest());
  for (; tick <= now; ++tick) {
    if (BodyState* past = memory->history().At(tick, body)) *past = rest.pose;
  }
}

}  // namespace

RestCommit::RestCommit(const SyncConfig& config, World& world, const Roles& roles,
                       const Drivers& drivers, BodyMemory& memory, Display& display,
                       const std::vector<InputTrack>& inputs, const Reach& reach)
    : config_(config),
      world_(world),
      roles_(roles),
      drivers_(drivers),
      memory_(memory),
      display_(display),
      inputs_(inputs),
      reach_(reach),
      table_(world.body_count()),
      watch_(world),
      disturbed_(static_cast<std::size_t>(world.body_count())) {}

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
  memory_.MoveParked(body);
}

void RestCommit::PutBack() {
  if (Off() || edited_) return;              // an edit's push must not be lost
  for (const int body : memory_.tended()) {  // a parked body is at rest already
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

/// Chooses the bodies to check. Absent bodies count only if they were heard of, moved, or released,
/// which may now be long enough ago.
void RestCommit::FindDue() {
  due_.clear();
  const auto add_absent = [this](const std::vector<int>& bodies) {
    for (const int body : bodies) {
      if (world_.motion(body) == Motion::kAbsent) due_.push_back(body);
    }
  };
  add_absent(memory_.news());
  add_absent(freed_);
  if (edited_) add_absent(memory_.tended());
  freed_.erase(std::remove_if(freed_.begin(), freed_.end(),
                              [this](int body) { return disturbed(body).released_tick < 0; }),
               freed_.end());
  std::sort(due_.begin(), due_.end());
  due_.erase(std::unique(due_.begin(), due_.end()), due_.end());
  due_.insert(due_.begin(), world_.present().begin(), world_.present().end());
}

void RestCommit::BeforeStep() {
  if (Off()) return;
  if (!Trusts()) driven_ = DrivenIn(world_, drivers_, inputs_, world_.tick() + 1);
  FindDue();
  for (const int body : due_) {
    EndOutdated(body);
    Hold(body);
  }
  edited_ = false;
}

void RestCommit::Hold(int body) {
  const std::int64_t back_after = Ticks(Trusts() ? kBackAfterTrusted : kBackAfter);
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
  const BodyState now = world_.Read(body);
  const bool simulated = world_.motion(body) == Motion::kDynamic && world_.awake(body);
  const bool moved = now.velocity.squaredNorm() > 0 || now.spin != 0;
  if (simulated && (Trusts() || edited_ || moved || Driven(body))) {
    LetGo(body);
  } else {
    Put(body);
  }
}

/// Returns true if a held body that the last step pushed is to be released.
bool RestCommit::ExceedsWakeLimit(int body) {
  const BodyState now = world_.Read(body);
  const float speed = now.velocity.norm(), spin = std::fabs(now.spin);
  if (speed > kWakeImpactSpeed || spin > kWakeImpactSpeed) return true;
  Disturbance& d = disturbed(body);
  const bool pushed = speed > kWakeShare * kSleepSpeed || spin > kWakeShare * kSleepSpin;
  d.pushed_ticks = pushed ? d.pushed_ticks + 1 : 0;
  if (d.pushed_ticks < Ticks(kPushedFor) << std::min(d.times, kWaitDoublings)) return false;
  ++d.times;
  d.pushed_ticks = 0;
  return true;
}

/// Decides for each body of an island that the engine woke in the last step. An own body touched
/// only by own bodies stays awake: no other peer's word is needed. Where all bodies are held and
/// have several owners, the engine wakes bodies that lean on slightly displaced copies in every
/// step; these count as pushes.
void RestCommit::HoldIsland(const std::vector<int>& island) {
  bool own_awake = false, others_awake = false, driven = false, only_own = true;
  for (const int body : island) {
    const bool struck = world_.awake(body) && world_.Read(body).velocity.norm() > kWakeImpactSpeed;
    driven = driven || struck || Driven(body);
    only_own = only_own && Own(body);
    if (Holds(body) || !world_.awake(body)) continue;
    (Own(body) ? own_awake : others_awake) = true;
  }
  for (const int body : island) {
    if (!Holds(body) || !world_.awake(body)) continue;
    const bool by_own = Own(body) && (own_awake || (only_own && !others_awake));
    const bool moves = world_.motion(body) == Motion::kDynamic;
    if (moves && (Trusts() || by_own || driven || ExceedsWakeLimit(body))) {
      LetGo(body);
    } else {
      Put(body);
    }
  }
}

void RestCommit::AfterStep() {
  if (Off()) return;
  bool woken = false, open = false;
  for (const int body : world_.present()) {  // an absent body is another peer's, or idle
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
  if (open && world_.tick() % config_.send_every() == 0) {
    // A body that this peer may still commit is never absent.
    for (const std::vector<int>& island : FindPresentIslands(world_)) CommitIsland(island);
  }
  std::vector<Rest> waiting;
  waiting.swap(waiting_);
  for (const Rest& rest : waiting) Receive(rest);
}

void RestCommit::Remap(const BodyRemap& change) {
  table_.Remap(change.bodies);
  std::vector<Disturbance> disturbed;
  for (const BodyOrigin& origin : change.bodies) {
    const bool same = origin.body >= 0 && origin.same;
    disturbed.push_back(same ? disturbed_[static_cast<std::size_t>(origin.body)] : Disturbance{});
  }
  disturbed_ = std::move(disturbed);
  for (int body = 0; body < world_.body_count(); ++body) {
    memory_.track(body).at_rest =
        table_.at(body).committed && this->disturbed(body).released_tick < 0;
  }
  freed_.clear();
  for (int body = 0; body < world_.body_count(); ++body) {
    if (this->disturbed(body).released_tick >= 0) freed_.push_back(body);
  }
  watch_.StartAnew();
  committed_.clear();
}

void RestCommit::StartAnew() {
  table_.Clear();
  watch_.StartAnew();
  disturbed_.assign(disturbed_.size(), Disturbance{});
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

}  // namespace seam
