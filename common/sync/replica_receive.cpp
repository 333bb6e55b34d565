/// Replica, incoming: other peers' states become corrections, snapshots or a replay.

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/sync/replica.h"
#include "common/sync/state_limits.h"

namespace seam {
namespace {

/// States of ticks still to come that may wait; a hostile peer could send many.
constexpr std::size_t kEarlyMax = 64;
constexpr std::int64_t kEarlyTicksMax = 120;
/// A copy slower than this may be taken to its authority's pose of rest at once, m/s and rad/s.
constexpr float kQuiet = 0.1f;
/// The same collision happens a tick or two apart at two peers. In between their velocities differ
/// by the whole blow, and carrying that difference on would strike twice. So a difference beyond
/// kOtherImpact, m/s, is looked for within this many ticks: the least one counts. 5 ticks see other
/// collisions too; 2 miss some of the same.
constexpr std::int64_t kImpactShift = 3;
constexpr float kOtherImpact = 1;

}  // namespace

Replica::Received Replica::Receive(const States& states) {
  ApplyEdits();
  Received result;
  if (states.tick > tick() || states.revision > revision()) {  // of what is still to come here
    if (early_.size() < kEarlyMax && states.tick <= tick() + kEarlyTicksMax &&
        states.tick > tick() - kEarlyTicksMax) {
      early_.push_back(states);
      result.used = static_cast<int>(states.id.size());
    } else {
      result.stale = static_cast<int>(states.id.size());
    }
    return result;
  }
  bool any_new = false;
  bool predicted = false;
  std::vector<std::pair<std::size_t, int>> secondary;  // entries to be corrected, with their body
  for (std::size_t i = 0; i < states.id.size(); ++i) {
    const int body = world_.BodyOfId(states.id[i]);
    if (body < 0) {
      ++result.unknown;
      continue;
    }
    if (states.revision < changed_at_[static_cast<std::size_t>(body)]) {
      ++result.stale;  // of another body of the same root
      continue;
    }
    const int mechanism = world_.mechanism(body);
    const AuthorityRecord& record = table_.at(mechanism);
    const bool placed = placed_[static_cast<std::size_t>(body)];
    if (placed && (record.authority == self_ || states.peer == self_)) {
      ++result.unknown;
      continue;
    }
    if (states.epoch[i] < record.epoch ||
        states.tick <= heard_tick_[static_cast<std::size_t>(body)]) {
      ++result.stale;
      continue;
    }
    ++result.used;
    any_new = true;
    heard_tick_[static_cast<std::size_t>(body)] = states.tick;
    if (config_.mode == Mode::kCentral && RoleOf(mechanism) == kRoleSecondary) predicted = true;
    if (ReceiveOne(states, i, body)) secondary.emplace_back(i, body);
  }
  const std::map<int, BodyState> common = CommonDifferences(states, secondary);
  for (const auto& [i, body] : secondary) {
    Correct(body, states, i, common.at(world_.mechanism(body)));
  }
  if (any_new) delay_.AddAge(tick() - states.tick);
  if (predicted) Predict(states);
  return result;
}

bool Replica::ReceiveOne(const States& states, std::size_t i, int body) {
  const BodyState remote = Unpack(states, i, world_.Read(body).angle);
  snapshots_.Add(body, states.tick, remote);
  if (!placed_[static_cast<std::size_t>(body)]) {
    placed_[static_cast<std::size_t>(body)] = true;
    barriers_.clear();  // from before it was here
    replay_from_ = -1;
    world_.Write(body, WithinLimits(remote, scene().speed_limit));
    *history_.At(tick(), body) = world_.Read(body);
    smoother_.Reset(body);
    return false;
  }
  return config_.mode == Mode::kBuffer && RoleOf(world_.mechanism(body)) == kRoleSecondary;
}

std::map<int, BodyState> Replica::CommonDifferences(
    const States& states, const std::vector<std::pair<std::size_t, int>>& entries) const {
  std::map<int, BodyState> sums;
  std::map<int, float> masses;
  for (const auto& [i, body] : entries) {
    const int m = world_.mechanism(body);
    BodyState& sum = sums[m];
    const BodyState* then = PastOf(body, states.tick);
    if (then == nullptr) continue;
    const BodyState remote = Unpack(states, i, then->angle);
    sum = PlusScaled(sum, Minus(remote, LikePastOf(body, states.tick, remote)), world_.mass(body));
    masses[m] += world_.mass(body);
  }
  for (auto& [m, sum] : sums) {
    if (masses[m] > 0) sum = PlusScaled(BodyState{}, sum, 1 / masses[m]);
  }
  return sums;
}

const BodyState* Replica::PastOf(int body, std::int64_t tick) const {
  if (tick < dynamic_since_[static_cast<std::size_t>(body)]) return nullptr;
  return history_.At(tick, body);
}

BodyState Replica::LikePastOf(int body, std::int64_t tick, const BodyState& remote) const {
  BodyState like = *PastOf(body, tick);
  float least = (remote.velocity - like.velocity).norm();
  if (least < kOtherImpact) return like;
  for (std::int64_t t = tick - kImpactShift; t <= tick + kImpactShift; ++t) {
    const BodyState* past = t <= this->tick() ? PastOf(body, t) : nullptr;
    if (past == nullptr) continue;
    const float difference = (remote.velocity - past->velocity).norm();
    if (difference >= least) continue;
    least = difference;
    like.velocity = past->velocity;
    like.spin = past->spin;
  }
  return like;
}

void Replica::Place(const States& states) {
  ApplyEdits();
  for (std::size_t i = 0; i < states.id.size(); ++i) {
    const int body = world_.BodyOfId(states.id[i]);
    if (body < 0 || placed_[static_cast<std::size_t>(body)]) continue;
    const BodyState remote = Unpack(states, i, world_.Read(body).angle);
    snapshots_.Add(body, states.tick, remote);
    placed_[static_cast<std::size_t>(body)] = true;
    barriers_.clear();  // from before it was here
    replay_from_ = -1;
    world_.Write(body, WithinLimits(remote, scene().speed_limit));
    if ((states.flags[i] & kStateAsleep) != 0) world_.SetAwake(body, false);
    *history_.At(tick(), body) = world_.Read(body);
    smoother_.Reset(body);
  }
}

void Replica::Correct(int body, const States& states, std::size_t i, const BodyState& common) {
  const int mechanism = world_.mechanism(body);
  ReconcileInput in;
  in.local = world_.Read(body);
  const BodyState* then = PastOf(body, states.tick);
  in.dt = static_cast<float>(tick() - states.tick) * world_.dt();
  // The wire's angle has lost its revolutions: it is the one nearest to where our copy was.
  const float angle_then = then != nullptr ? then->angle : in.local.angle - in.dt * in.local.spin;
  in.remote = Unpack(states, i, angle_then);
  const bool quiet = in.local.velocity.norm() < kQuiet && std::fabs(in.local.spin) < kQuiet;
  if ((states.flags[i] & kStateAsleep) != 0 && quiet) {
    // At rest as far as the authority knows: take its pose bit for bit, so that all peers end with
    // the same numbers. Our copy is neither woken nor put to sleep by it: either would start the
    // engine's time to sleep again, for all that it touches.
    if (config_.pull != nullptr) pulls_[static_cast<std::size_t>(body)].arrived = -1;
    if (in.remote.position == in.local.position && in.remote.angle == in.local.angle) return;
    BodyState moved = Minus(in.remote, in.local);
    moved.velocity.setZero();
    moved.spin = 0;
    smoother_.Moved(body, moved);
    world_.Write(body, in.remote, false);
    *history_.At(tick(), body) = world_.Read(body);
    return;
  }
  if (config_.resimulates && ReplayFrom(body, states.tick)) return;
  BodyState like;
  if (then != nullptr) {
    like = LikePastOf(body, states.tick, in.remote);
    in.local_then = &like;
  }
  in.since_impact =
      static_cast<float>(tick() - last_impact_tick_[static_cast<std::size_t>(body)]) * world_.dt();
  in.coupled =
      last_coupled_tick_[static_cast<std::size_t>(mechanism)] >= tick() - config_.tick_hz / 4;
  in.gain = GainFor(in.dt);
  in.common = common;
  in.alone =
      world_.composition().mechanisms[static_cast<std::size_t>(mechanism)].assemblies.size() == 1;
  for (const BlockedDirection& blocked : world_.blocked_directions()) {
    if (world_.mechanism(blocked.body) != mechanism || in.blocked_count == 2) continue;
    const bool known =
        in.blocked_count == 1 && std::fabs(blocked.normal.dot(in.blocked_directions[0])) > 0.9f;
    if (!known) in.blocked_directions[in.blocked_count++] = blocked.normal;
  }
  const Correction c = config_.reconcile(in);
  if (Negligible(c.now)) {
    if (config_.pull != nullptr) NoteArrival(body);
    return;
  }
  const BodyState corrected = WithinLimits(PlusScaled(in.local, c.now, 1), scene().speed_limit);
  if (c.rewrites_history) {
    // The past is corrected too, so that the next message is compared with what we now believe.
    const float steps = static_cast<float>(std::max<std::int64_t>(1, tick() - states.tick));
    for (std::int64_t t = states.tick; t < tick(); ++t) {
      BodyState* past = history_.At(t, body);
      if (past == nullptr) continue;
      const float s = static_cast<float>(t - states.tick) / steps;
      *past = PlusScaled(*past, PlusScaled(c.then, Minus(c.now, c.then), s), 1);
    }
  }
  world_.Write(body, corrected);
  *history_.At(tick(), body) = corrected;
  smoother_.Moved(body, Minus(corrected, in.local));
  if (config_.pull != nullptr) NoteArrival(body);
}

}  // namespace seam
