/// RestCommit: sends this peer's commitments and receives those of other peers.

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/geometry.h"
#include "common/sync/rest/rest_commit.h"
#include "common/sync/state_arithmetic.h"
#include "common/sync/state_limits.h"

namespace seam {
namespace {

/// Time that an island must have slept before it is committed, s.
constexpr double kAsleepFor = 0.25;
/// A copy that is moved farther than this, m and rad, may have supported own bodies.
constexpr float kMoved = 0.005f;
/// Number of times that an own body at rest is woken by such a move; after that its pose is as good
/// as the other peer's.
constexpr int kMovedTimes = 3;
/// Most that a waiting message may be in the future, s.
constexpr double kWaitingFor = 2;

}  // namespace

std::int64_t RestCommit::Assumed(int body) const {
  if (!config_.policy->SendsCompleteTicks()) return 0;
  return world_.tick() - reach_.CompleteTick(world_.mechanism(body));
}

/// True if the body lay `ago` ticks ago exactly where it lies. A replay may have woken it since
/// then, although it has never been seen awake.
bool RestCommit::LayThere(int body, std::int64_t ago) const {
  if (ago == 0) return true;  // this tick is not recorded yet
  const BodyState* const then = memory_.history().At(world_.tick() - ago, body);
  return then != nullptr && SamePose(*then, world_.Read(body));
}

bool RestCommit::MayCommit(const std::vector<int>& island, const std::vector<int>& own) const {
  const auto asleep = [&](int b) {
    const std::int64_t assumed = Assumed(b);
    return watch_.asleep(b) >= Ticks(kAsleepFor) + assumed && LayThere(b, assumed);
  };
  if (std::all_of(own.begin(), own.end(), asleep)) return true;
  return MayCommitAwake(island, own);
}

void RestCommit::CommitIsland(const std::vector<int>& island) {
  std::vector<int> own;
  for (const int body : island) {
    if (!Own(body) || Holds(body)) continue;
    if (!memory_.track(body).placed || world_.activity(body) != Activity::kSimulated) return;
    own.push_back(body);
  }
  if (own.empty() || !MayCommit(island, own)) return;
  for (const int body : own) Commit(body);
}

void RestCommit::Commit(int body) {
  // It has slept since before the newest input-complete tick (MayCommit). A later tick would be an
  // assumption: a peer that already knows an input since then would put the body to rest again.
  const std::int64_t as_of = world_.tick() - Assumed(body);
  // Later than anything another authority can have said of it; that peer's clock may be a tick
  // ahead.
  const std::int64_t tick =
      std::max({as_of, table_.at(body).tick + 1, memory_.track(body).heard_tick});
  const std::int32_t epoch = roles_.table().at(world_.mechanism(body)).epoch;
  table_.Commit(body, world_.id(body), epoch, tick, world_.Read(body));
  memory_.track(body).at_rest = true;
  disturbed(body).pushed_ticks = 0;
  disturbed(body).released_tick = -1;
  Put(body);
  committed_.push_back(body);
}

std::vector<Rest> RestCommit::Take() {
  std::vector<int> bodies;
  for (const int body : std::exchange(committed_, {})) {
    if (table_.at(body).committed && Own(body)) bodies.push_back(body);
  }
  // A peer that catches up steps many times in one go: a body may have come to rest twice.
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  std::vector<Rest> out = table_.Pack(world_, roles_.self(), bodies);
  for (Rest& rest : out) rest.number = number_++;
  return out;
}

std::vector<Rest> RestCommit::Everything() const {
  std::vector<int> bodies;
  for (int body = 0; body < world_.body_count(); ++body) {
    if (table_.at(body).committed) bodies.push_back(body);
  }
  return table_.Pack(world_, roles_.self(), bodies);
}

std::vector<Rest> RestCommit::Again(const std::vector<int>& bodies) const {
  std::vector<int> held;
  for (const int body : bodies) {
    if (table_.at(body).committed && Holds(body)) held.push_back(body);
  }
  return table_.Pack(world_, roles_.self(), held, world_.tick());
}

std::uint32_t RestCommit::HashOf(const RestBlock& at, int peer) const {
  std::uint64_t sum = 0;
  const int count = world_.body_count();
  for (int body = at.begin(count); body < at.end(count); ++body) {
    if (peer < 0 || AuthorityOf(body) == peer) sum += table_.HashOf(body);
  }
  return static_cast<std::uint32_t>(sum);
}

std::vector<Rest> RestCommit::Again(const RestBlock& at, int peer) const {
  std::vector<int> told;
  const int count = world_.body_count();
  for (int body = at.begin(count); body < at.end(count); ++body) {
    if (peer < 0 || AuthorityOf(body) == peer) told.push_back(body);
  }
  return Again(told);
}

bool RestCommit::Receive(const Rest& rest) {
  if (Off()) return false;
  if (rest.tick > world_.tick()) {
    const bool soon = rest.tick <= world_.tick() + Ticks(kWaitingFor);
    if (soon && waiting_.size() < kEarlyMessagesMax) waiting_.push_back(rest);
    return false;
  }
  bool placed = false;
  for (std::size_t i = 0; i < rest.id.size(); ++i) placed = ReceiveOne(rest, i) || placed;
  return placed;
}

/// Returns true if a simulated copy was at that pose at `tick` and was woken later: the commitment
/// merely arrives late. It may have come to rest elsewhere meanwhile.
bool RestCommit::WokenSince(int body, std::int64_t tick, const BodyState& pose) const {
  if (!config_.policy->TrustsSleep() || !roles_.Simulates(body)) return false;
  const BodyState* then = memory_.history().At(tick, body);
  if (then == nullptr) return false;
  const bool lay = then->velocity.squaredNorm() == 0 && then->spin == 0;
  if (!world_.awake(body) && (!lay || SamePose(world_.Read(body), *then))) return false;
  const BodyState off = Minus(pose, *then);
  return off.position.norm() < kMoved && std::fabs(WrapAngle(off.angle)) < kMoved;
}

bool RestCommit::ReceiveOne(const Rest& rest, std::size_t i) {
  const int body = world_.BodyOfId(rest.id[i]);
  if (body < 0) return false;
  BodyTrack& track = memory_.track(body);
  const bool places = !track.placed;
  if (!places && Own(body)) return false;
  if (rest.revision < track.changed_at) return false;
  // Another authority's clock may be ahead of ours: a newer epoch overrides the tick.
  if (rest.epoch[i] <= track.heard_epoch && rest.tick < track.heard_tick) return false;
  const RestRecord& known = table_.at(body);
  if (known.committed && rest.epoch[i] <= known.epoch && rest.tick < known.tick) return false;
  BodyState pose;
  pose.position = Vec2(rest.x[i], rest.y[i]);
  pose.angle = rest.angle[i];
  if (!places && WokenSince(body, rest.tick, pose)) {
    // It moves on until its authority reports motion, or goes back to the committed pose.
    table_.Commit(body, rest.id[i], rest.epoch[i], rest.tick, pose);
    track.heard_tick = rest.tick;
    track.heard_epoch = rest.epoch[i];
    if (disturbed(body).released_tick < 0) LetGo(body);
    return false;
  }
  const BodyState moved = Minus(pose, world_.Read(body));
  table_.Commit(body, rest.id[i], rest.epoch[i], rest.tick, pose);
  track.at_rest = track.placed = true;
  track.heard_tick = rest.tick;
  track.heard_epoch = rest.epoch[i];
  track.asleep_since = world_.tick();
  track.pull.arrived = -1;
  disturbed(body) = Disturbance{};
  if (places) memory_.snapshots().ForgetAfter(body, rest.tick - 1);  // that was an assumption
  memory_.snapshots().Add(body, rest.tick, pose);
  memory_.MarkUpdated(body);
  std::int64_t tick = std::max(rest.tick, memory_.history().oldest());
  for (; tick <= world_.tick() && !memory_.parked(body); ++tick) {
    if (BodyState* past = memory_.history().At(tick, body)) *past = pose;
  }
  Put(body);
  if (places) {
    display_.Reset(body);
    return true;
  }
  if (moved.position.norm() > kMoved || std::fabs(WrapAngle(moved.angle)) > kMoved)
    WakeNeighbours(body);
  return false;
}

void RestCommit::ProlongHandedOver(const ExactStates& exact) {
  for (std::size_t i = 0; i < exact.id.size(); ++i) {
    const int body = world_.BodyOfId(exact.id[i]);
    if (body < 0 || !table_.at(body).committed) continue;
    const BodyState& pose = table_.at(body).pose;
    const bool lies = exact.x[i] == pose.position.x() && exact.y[i] == pose.position.y() &&
                      exact.angle[i] == pose.angle && exact.vx[i] == 0 && exact.vy[i] == 0 &&
                      exact.spin[i] == 0;
    // Only if nothing newer was heard: a hand-over that was not accepted says nothing of the body.
    const bool newest = memory_.track(body).heard_tick == exact.tick;
    if (lies && newest && exact.tick > table_.at(body).tick) table_.Prolong(body, exact.tick);
  }
}

/// Wakes own bodies that touched the moved copy: they may have lost their support.
void RestCommit::WakeNeighbours(int body) {
  for (const Touch& touch : world_.touches()) {
    if (touch.body_a != body && touch.body_b != body) continue;
    const int other = touch.body_a == body ? touch.body_b : touch.body_a;
    if (!Own(other) || world_.activity(other) != Activity::kSimulated) continue;
    if (Holds(other)) {
      if (++disturbed(other).times > kMovedTimes) continue;
      LetGo(other);
    }
    world_.SetAwake(other, true);
  }
}

}  // namespace seam
