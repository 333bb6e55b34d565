#include "server/state_filter.h"

#include <algorithm>
#include <cmath>

#include "common/scene/scene_limits.h"
#include "server/interest/pose_entry.h"
#include "server/rules/bounds_watch.h"

namespace seam {
namespace {

/// States farther in the past or future than this are dropped, s.
constexpr double kStatesPast = 2.0;
constexpr double kStatesFuture = 0.5;

/// Copies the entries `kept` (ascending) of an array of a message. Mostly all entries are kept.
template <class T>
void KeepOf(const std::vector<T>& from, const std::vector<std::size_t>& kept, std::vector<T>* to) {
  if (kept.size() == from.size()) {
    to->assign(from.begin(), from.end());
    return;
  }
  to->clear();
  for (const std::size_t i : kept) to->push_back(from[i]);
}

void KeepOf(const States& from, const std::vector<std::size_t>& kept, States* to) {
  KeepOf(from.id, kept, &to->id);
  KeepOf(from.epoch, kept, &to->epoch);
  KeepOf(from.flags, kept, &to->flags);
  KeepOf(from.x, kept, &to->x);
  KeepOf(from.y, kept, &to->y);
  KeepOf(from.angle, kept, &to->angle);
  KeepOf(from.vx, kept, &to->vx);
  KeepOf(from.vy, kept, &to->vy);
  KeepOf(from.spin, kept, &to->spin);
}

/// Appends velocity and spin of the i-th body of `from` to `to`.
template <class Message>
void AddMotion(const Message& from, std::size_t i, Message* to) {
  to->vx.push_back(from.vx[i]);
  to->vy.push_back(from.vy[i]);
  to->spin.push_back(from.spin[i]);
}

}  // namespace

StateFilter::StateFilter(const Scene& scene, const Replica& replica,
                         const AuthorityManager& authority, const EditLog& edits, TrustMode trust,
                         Stats& stats)
    : scene_(scene),
      replica_(replica),
      authority_(authority),
      edits_(edits),
      stats_(stats),
      trust_(trust),
      plausible_(scene, replica),
      outside_(replica.table(), BodyRule::kSame) {}

bool StateFilter::HeaderAcceptable(int peer, const States& states) {
  const double hz = scene_.solver.tick_hz;
  const auto age = static_cast<double>(replica_.tick() - states.tick);
  if (states.peer != peer) {
    ++stats_.dropped_right;
    return false;
  }
  if (age > kStatesPast * hz || age < -kStatesFuture * hz) {
    ++stats_.dropped_stale;
    return false;
  }
  if (edits_.Differs(states.revision, states.composition) ||
      states.revision > replica_.revision()) {
    ++stats_.dropped_implausible;  // the peer's next ping triggers a repair
    return false;
  }
  return true;
}

bool StateFilter::Believed(int body, const Claim& claim) {
  const BodyState& state = claim.state;
  if (OutsideBounds(scene_, state.position)) return false;
  if (state.velocity.norm() > scene_.speed_limit || std::fabs(state.spin) > kSpinMax) return false;
  const bool plausible = trust_ == TrustMode::kOff ||
                         plausible_.Judge(body, claim.tick, claim.revision, state, !claim.rests);
  if (trust_ == TrustMode::kAct) return plausible;
  return plausible_.Reachable(body, claim.tick, state.position, 1);
}

/// A state must be newer than the last accepted one: a dropped state is replaced by the next. A
/// rest commit is sent once. So it counts in a newer epoch even if its tick is older, since the
/// clock of the holder before may have been ahead; and it may be repeated for the same tick.
bool StateFilter::Outdated(int body, const Claim& claim) const {
  const Plausible::Accepted& last = plausible_.accepted(body);
  if (!claim.rests) return claim.tick <= last.tick;
  return claim.epoch <= last.epoch && claim.tick < last.tick;
}

std::int32_t StateFilter::EpochOf(int body) const {
  return replica_.authority().at(replica_.world().mechanism(body)).epoch;
}

bool StateFilter::MayMove(int body, const Claim& claim) {
  if (body < 0) {
    ++(claim.revision < replica_.revision() ? stats_.dropped_stale : stats_.dropped_right);
    return false;
  }
  if (!replica_.SameBody(body, claim.revision)) {
    ++stats_.dropped_stale;
    return false;
  }
  switch (authority_.RightToMove(claim.peer, body, claim.epoch)) {
    case AuthorityManager::Right::kYes: break;
    case AuthorityManager::Right::kStale: ++stats_.dropped_stale; return false;
    case AuthorityManager::Right::kNo: ++stats_.dropped_right; return false;
  }
  // A rest commit is valid in one epoch; the holder commits again in the next.
  if (claim.rests && claim.epoch != EpochOf(body)) {
    ++stats_.dropped_stale;
    return false;
  }
  if (Outdated(body, claim)) {
    ++stats_.dropped_stale;
    return false;
  }
  if (!Believed(body, claim)) {
    const Vec2& at = claim.state.position;
    // A body in long free fall exceeds the speed limit, so none of its states is accepted.
    if (OutsideBounds(scene_, at) && plausible_.Reachable(body, claim.tick, at, 2)) {
      outside_[body] = 1;
      any_outside_ = true;
    }
    ++stats_.dropped_implausible;
    return false;
  }
  return true;
}

const States& StateFilter::Keep(std::int64_t now_us, int peer, const States& states) {
  States& kept = kept_;
  passed_.clear();
  const bool any = HeaderAcceptable(peer, states);
  for (std::size_t i = 0; any && i < states.id.size(); ++i) {
    const int body = replica_.world().BodyOfId(states.id[i]);
    const Claim claim{states.peer,     states.tick,          states.revision,
                      states.epoch[i], Unpack(states, i, 0), false};
    if (!MayMove(body, claim)) continue;
    plausible_.Accept(body, {states.tick, states.epoch[i], claim.state});
    passed_.push_back(i);
  }
  KeepOf(states, passed_, &kept);
  if (passed_.empty()) return kept;
  kept.utime = now_us;
  kept.peer = states.peer;
  kept.tick = states.tick;
  kept.revision = states.revision;
  kept.composition = states.composition;
  kept.origin_x = states.origin_x;
  kept.origin_y = states.origin_y;
  // A holder that keeps its mechanism may not know the newest epoch yet.
  for (std::size_t i = 0; i < kept.id.size(); ++i) {
    const int body = replica_.world().BodyOfId(kept.id[i]);
    kept.epoch[i] = EpochOf(body);
    // A jointed body does not fall freely: an edit may just have joined it, unknown to its holder.
    const bool falls = (kept.flags[i] & kStateFalls) != 0;
    if (falls && replica_.world().Joined(body)) kept.flags[i] ^= kStateFalls;
  }
  return kept;
}

Rest StateFilter::Keep(std::int64_t now_us, int peer, const Rest& rest) {
  Rest kept;
  if (rest.peer != peer) {
    ++stats_.dropped_right;
    return kept;
  }
  const double ahead = static_cast<double>(rest.tick - replica_.tick());
  if (rest.revision > replica_.revision() || edits_.Differs(rest.revision, rest.composition) ||
      ahead > kStatesFuture * scene_.solver.tick_hz) {
    ++stats_.dropped_implausible;
    return kept;
  }
  kept = rest;
  kept.utime = now_us;
  kept.id.clear(), kept.epoch.clear(), kept.x.clear(), kept.y.clear(), kept.angle.clear();
  for (std::size_t i = 0; i < rest.id.size(); ++i) {
    const int body = replica_.world().BodyOfId(rest.id[i]);
    BodyState pose;
    pose.position = Vec2(rest.x[i], rest.y[i]);
    pose.angle = rest.angle[i];
    if (!MayMove(body, {peer, rest.tick, rest.revision, rest.epoch[i], pose, true})) continue;
    plausible_.Accept(body, {rest.tick, rest.epoch[i], pose});
    AddPose(rest, i, &kept);
  }
  return kept;
}

bool StateFilter::MayRelease(int peer, int body, const ExactStates& exact, std::size_t i) {
  if (body < 0 || !replica_.SameBody(body, exact.revision)) {
    ++stats_.dropped_stale;
    return false;
  }
  switch (authority_.RightToRelease(peer, body, exact.epoch[i])) {
    case AuthorityManager::Right::kYes: break;
    case AuthorityManager::Right::kStale: ++stats_.dropped_stale; return false;
    case AuthorityManager::Right::kNo: ++stats_.dropped_right; return false;
  }
  if (exact.tick < plausible_.accepted(body).tick) {
    ++stats_.dropped_stale;
    return false;
  }
  const BodyState state{
      {exact.x[i], exact.y[i]}, exact.angle[i], {exact.vx[i], exact.vy[i]}, exact.spin[i]};
  if (Believed(body, {peer, exact.tick, exact.revision, exact.epoch[i], state, false})) return true;
  ++stats_.dropped_implausible;
  return false;
}

ExactStates StateFilter::KeepExact(int peer, const ExactStates& exact) {
  ExactStates kept;
  const double hz = scene_.solver.tick_hz;
  const auto age = static_cast<double>(replica_.tick() - exact.tick);
  const bool now = age <= kStatesPast * hz && age >= -kStatesFuture * hz;
  if (!now || exact.revision > replica_.revision()) {
    ++stats_.dropped_stale;
    return kept;
  }
  kept.tick = exact.tick;
  kept.revision = exact.revision;
  for (std::size_t i = 0; i < exact.id.size(); ++i) {
    const int body = replica_.world().BodyOfId(exact.id[i]);
    if (!MayRelease(peer, body, exact, i)) continue;
    plausible_.Accept(
        body,
        {exact.tick,
         exact.epoch[i],
         {{exact.x[i], exact.y[i]}, exact.angle[i], {exact.vx[i], exact.vy[i]}, exact.spin[i]}});
    AddPose(exact, i, &kept);
    AddMotion(exact, i, &kept);
  }
  return kept;
}

std::vector<int> StateFilter::TakeOutside() {
  std::vector<int> bodies;
  if (!std::exchange(any_outside_, false)) return bodies;
  for (int body = 0; body < outside_.size(); ++body) {
    if (std::exchange(outside_[body], 0) != 0) bodies.push_back(body);
  }
  return bodies;
}

}  // namespace seam
