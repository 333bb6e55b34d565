#include "common/sync/blend/blender.h"

#include <algorithm>
#include <cmath>

#include "common/base/trig.h"
#include "common/sync/quantize.h"
#include "common/sync/reach/way_to.h"
#include "common/sync/state_limits.h"

namespace seam {
namespace {

/// A copy slower than this may take its authority's rest pose at once, m/s and rad/s.
constexpr float kQuiet = 0.1f;
/// The same collision happens a tick or two apart at two peers. In between, their velocities differ
/// by the whole impact, and correcting that difference would apply the impact twice. A difference
/// beyond kOtherImpact, m/s, is therefore compared over this many ticks to each side, and the
/// smallest one counts. 5 ticks match other collisions too; 2 miss some of the same.
constexpr std::int64_t kImpactShift = 3;
constexpr float kOtherImpact = 1;

/// Largest stable share of a difference to correct at once, when peers correct towards each other
/// with a delay of `dt` s, `send_hz` times a second.
float GainFor(float dt, int send_hz) {
  // A pure correction delayed by d updates is stable below 2 sin(pi / (2 (2 d + 1))).
  const double d = std::ceil(static_cast<double>(dt) * send_hz);
  const double limit = 2 * Sin(kPi / (2 * (2 * d + 1)));
  constexpr double kShareOfLimit = 0.25;  // above 0.4 a tall stack never rests at 200 ms
  return static_cast<float>(std::min(1.0, kShareOfLimit * limit));
}

void FindBlockedDirections(const World& world, int mechanism, ReconcileInput* in) {
  for (const BlockedDirection& blocked : world.blocked_directions()) {
    if (world.mechanism(blocked.body) != mechanism || in->blocked_count == 2) continue;
    const bool known = in->blocked_count == 1 &&
                       std::fabs(blocked.normal.dot(in->blocked_directions[0])) > kSameDirection;
    if (!known) in->blocked_directions[in->blocked_count++] = blocked.normal;
  }
}

}  // namespace

std::map<int, BodyState> Blender::CommonDifferences(const States& states,
                                                    const std::vector<Entry>& entries) const {
  std::map<int, BodyState> sums;
  std::map<int, float> masses;
  for (const auto& [i, body] : entries) {
    const int m = world_.mechanism(body);
    BodyState& sum = sums[m];
    const BodyState* then = memory_.ComparablePast(body, states.tick);
    if (then == nullptr) continue;
    const BodyState remote = Unpack(states, i, then->angle);
    sum = PlusScaled(sum, Minus(remote, LikePast(body, states.tick, remote)), world_.mass(body));
    masses[m] += world_.mass(body);
  }
  for (auto& [m, sum] : sums) {
    if (masses[m] > 0) sum = PlusScaled(BodyState{}, sum, 1 / masses[m]);
  }
  return sums;
}

BodyState Blender::LikePast(int body, std::int64_t tick, const BodyState& remote) const {
  BodyState like = *memory_.ComparablePast(body, tick);
  float least = (remote.velocity - like.velocity).norm();
  if (least < kOtherImpact) return like;
  for (std::int64_t t = tick - kImpactShift; t <= tick + kImpactShift; ++t) {
    const BodyState* past = t <= world_.tick() ? memory_.ComparablePast(body, t) : nullptr;
    if (past == nullptr) continue;
    const float difference = (remote.velocity - past->velocity).norm();
    if (difference >= least) continue;
    least = difference;
    like.velocity = past->velocity;
    like.spin = past->spin;
  }
  return like;
}

void Blender::Correct(const States& states, const std::vector<Entry>& entries) {
  const std::map<int, BodyState> common = CommonDifferences(states, entries);
  for (const auto& [i, body] : entries) {
    CorrectOne(body, states, i, common.at(world_.mechanism(body)));
  }
}

void Blender::CorrectOne(int body, const States& states, std::size_t i, const BodyState& common) {
  const int mechanism = world_.mechanism(body);
  ReconcileInput in;
  in.local = world_.Read(body);
  const BodyState* then = memory_.ComparablePast(body, states.tick);
  in.dt = static_cast<float>(world_.tick() - states.tick) * world_.dt();
  // The wire's angle has lost its revolutions; the one nearest to our copy's past is meant.
  const float angle_then = then != nullptr ? then->angle : in.local.angle - in.dt * in.local.spin;
  in.remote = Unpack(states, i, angle_then);
  const bool quiet = in.local.velocity.norm() < kQuiet && std::fabs(in.local.spin) < kQuiet;
  const bool goes_back = config_.policy->GoesBack(roles_.self());
  if ((states.flags[i] & kStateAsleep) != 0 && quiet && !goes_back) {
    TakeRest(body, in.local, in.remote);
    return;
  }
  BodyState like;
  if (then != nullptr) {
    like = LikePast(body, states.tick, in.remote);
    in.local_then = &like;
    const float gained = in.local.velocity.squaredNorm() - then->velocity.squaredNorm();
    in.speed_max = std::sqrt(std::max(0.0f, in.remote.velocity.squaredNorm() + gained));
  }
  in.since_impact =
      static_cast<float>(world_.tick() - memory_.track(body).last_impact_tick) * world_.dt();
  in.coupled = memory_.Coupled(mechanism);
  in.gain = GainFor(in.dt, config_.send_hz);
  in.common = common;
  in.alone =
      world_.composition().mechanisms[static_cast<std::size_t>(mechanism)].assemblies.size() == 1;
  FindBlockedDirections(world_, mechanism, &in);
  Correction c = config_.reconcile(in);
  const Vec2 target = in.local.position + c.now.position;
  const Vec2 there = WayTo(world_, memory_, body, in.remote.position, states.tick, target);
  if (there != target) c.now.position = there - in.local.position;
  if (!Negligible(c.now)) Apply(body, in.local, c, states.tick);
  RecordArrival(body);
}

/// Takes the pose of a copy that rests as far as its authority knows. A difference within the
/// wire's rounding is left: the Rest message brings the exact pose, and a body woken earlier
/// continues from the same numbers. The copy is neither woken nor put to sleep: either would
/// restart the engine's sleep timer for all bodies that it touches.
void Blender::TakeRest(int body, const BodyState& local, const BodyState& remote) {
  memory_.track(body).pull.arrived = -1;
  BodyState moved = Minus(remote, local);
  moved.velocity.setZero();
  moved.spin = 0;
  if (Negligible(moved)) return;
  display_.Moved(body, moved);
  world_.Write(body, remote, false);
  *memory_.history().At(world_.tick(), body) = world_.Read(body);
}

/// Applies the rule's correction for a message of tick `from`.
void Blender::Apply(int body, const BodyState& local, const Correction& c, std::int64_t from) {
  const std::int64_t now = world_.tick();
  const BodyState corrected = WithinLimits(PlusScaled(local, c.now, 1), world_.scene().speed_limit);
  if (c.rewrites_history) {
    // Corrects the past too, so that the next message is compared with our new belief.
    const float steps = static_cast<float>(std::max<std::int64_t>(1, now - from));
    for (std::int64_t t = from; t < now; ++t) {
      BodyState* past = memory_.history().At(t, body);
      if (past == nullptr) continue;
      const float s = static_cast<float>(t - from) / steps;
      *past = PlusScaled(*past, PlusScaled(c.then, Minus(c.now, c.then), s), 1);
    }
  }
  const std::int64_t since = memory_.track(body).dynamic_since;
  if (!c.rewrites_history && from < since && config_.pull == nullptr) {
    // The copy was placed for lack of a past. Its recent past moves along, or the next message
    // would find the same difference again. A puller does not use the past.
    for (std::int64_t t = since; t < now; ++t) {
      if (BodyState* past = memory_.history().At(t, body)) *past = PlusScaled(*past, c.now, 1);
    }
  }
  world_.Write(body, corrected);
  *memory_.history().At(now, body) = corrected;
  display_.Moved(body, Minus(corrected, local));
}

}  // namespace seam
