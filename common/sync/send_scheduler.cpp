#include "common/sync/send_scheduler.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "common/sync/lease.h"

namespace seam {
namespace {

/// Growth of the priority per send (after Fiedler, "State Synchronization", 2015): a body that just
/// collided is interesting, a sleeping one is rarely repeated.
constexpr float kPriorityImpact = 10;
constexpr float kPriorityAwake = 1;
/// Sleeping bodies are repeated this often, s: final poses arrive in spite of loss.
constexpr double kAsleepRepeat = 0.5;
/// ...and at once this many times when they fall asleep.
constexpr int kAsleepBurst = 4;

}  // namespace

SendScheduler::SendScheduler(const SyncConfig& config, World& world, const Roles& roles,
                             BodyMemory& memory, const Reach& reach, const Replay& replay)
    : config_(config),
      world_(world),
      roles_(roles),
      memory_(memory),
      reach_(reach),
      replay_(replay) {}

void SendScheduler::Collect() {
  outgoing_.clear();
  if (!config_.policy->SendsStates() || world_.tick() % config_.send_every() != 0) return;
  std::map<std::pair<std::int64_t, int>, std::vector<WireBody>> told;  // by tick and authority
  for (const int body : ChooseBodies()) {
    const int authority = roles_.table().at(world_.mechanism(body)).authority;
    const std::int64_t tick = TickToSend(body);
    told[{tick, authority}].push_back(Tell(body, tick));
    NoteTold(body, tick);
  }
  for (const auto& [of, bodies] : told) {
    States header = Header();
    std::tie(header.tick, header.peer) = of;
    for (States& states : Pack(header, bodies)) outgoing_.push_back(std::move(states));
  }
}

/// Returns the tick for which a body's state is sent. If unknown inputs can have reached the body,
/// that is the newest tick that they cannot have changed: our assumption must not overwrite the
/// better knowledge of other peers. States in a silent holder's name are of now: no peer knows
/// better.
std::int64_t SendScheduler::TickToSend(int body) const {
  const std::int64_t now = world_.tick();
  const int m = world_.mechanism(body);
  if (!config_.policy->SendsCompleteTicks() || !roles_.IsAuthority(m)) return now;
  const std::int64_t complete = FinalTick(m);
  return memory_.ComparablePast(body, complete) != nullptr ? complete : now;
}

/// Returns the newest tick for which no future input can change our state.
std::int64_t SendScheduler::FinalTick(int mechanism) const {
  if (!config_.policy->SendsCompleteTicks()) return world_.tick();
  return std::min(reach_.CompleteTick(mechanism), replay_.settled());
}

/// Records the tick of a final state that was sent: it can be a fact (Replay::IsFact).
void SendScheduler::NoteTold(int body, std::int64_t tick) {
  const int m = world_.mechanism(body);
  if (!roles_.IsAuthority(m) || tick > FinalTick(m)) return;
  BodyTrack& track = memory_.track(body);
  track.told_tick = std::max(track.told_tick, tick);
}

std::vector<States> SendScheduler::Take() { return std::exchange(outgoing_, {}); }

bool SendScheduler::Due(int body) {
  BodyTrack& track = memory_.track(body);
  if (track.at_rest) return false;  // a Rest message carries it
  const int m = world_.mechanism(body);
  if (roles_.IsAuthority(m) && roles_.RefreshesOnly(m) && !memory_.Unsettled(m)) {
    const bool anew = track.sent_epoch != roles_.table().at(m).epoch;
    return anew || world_.tick() - track.sent_tick >= RefreshEvery(config_.tick_hz);
  }
  if (world_.awake(body)) {
    track.asleep_since = -1;
    return true;
  }
  if (track.asleep_since < 0) track.asleep_since = world_.tick();
  const std::int64_t slept = world_.tick() - track.asleep_since;
  const auto repeat = static_cast<std::int64_t>(kAsleepRepeat * config_.tick_hz);
  return slept < kAsleepBurst * config_.send_every() ||
         (slept + body) % repeat < config_.send_every();
}

/// True if this peer sends the body's state. In a silent holder's name only for moving bodies:
/// others come to rest without help.
bool SendScheduler::SendsStateOf(int body) const {
  const int m = world_.mechanism(body);
  if (roles_.IsAuthority(m)) return true;
  return roles_.SpeaksForHolder(m) && world_.Read(body).velocity.norm() > kStandInSpeed;
}

/// Returns body indices, ascending.
std::vector<int> SendScheduler::ChooseBodies() {
  std::vector<int> due;
  for (const int body : world_.present()) {  // no peer sends states of others
    BodyTrack& track = memory_.track(body);
    if (!SendsStateOf(body) || !track.placed || !Due(body)) continue;
    const bool hit = world_.awake(body) && memory_.Struck(body);
    track.priority += hit ? kPriorityImpact : kPriorityAwake;
    due.push_back(body);
  }
  std::stable_sort(due.begin(), due.end(), [&](int a, int b) {
    return memory_.track(a).priority > memory_.track(b).priority;
  });
  // The server selects again for each receiver, within its budget (SendQueue).
  if (roles_.self() > 0 && due.size() > kBodiesPerSend) due.resize(kBodiesPerSend);
  std::sort(due.begin(), due.end());
  return due;
}

WireBody SendScheduler::Describe(int body, const BodyState& state, bool asleep) const {
  WireBody wire = Quantise(state);
  wire.id = world_.id(body);
  wire.epoch = roles_.table().at(world_.mechanism(body)).epoch;
  wire.flags = asleep ? kStateAsleep : std::int8_t{0};
  return wire;
}

WireBody SendScheduler::Tell(int body, std::int64_t tick) {
  BodyTrack& track = memory_.track(body);
  track.priority = 0;
  track.sent_tick = world_.tick();
  track.sent_epoch = roles_.table().at(world_.mechanism(body)).epoch;
  BodyState state = world_.Read(body);
  bool asleep = !world_.awake(body);
  if (asleep) {
    state.velocity.setZero();
    state.spin = 0;
  }
  if (tick < world_.tick()) {
    state = *memory_.ComparablePast(body, tick);
    asleep = asleep && !(state.velocity.squaredNorm() > 0 || state.spin != 0);
  }
  // The sender continues from its own numbers, moving or at rest: writing the rounded pose back
  // topples a stack of ten boxes even in a world of its own (docs/lessons.md).
  WireBody wire = Describe(body, state, asleep);
  if (memory_.Struck(body)) wire.flags |= kStateImpact;
  if (!asleep && memory_.FallsFreely(body, tick, state)) wire.flags |= kStateFalls;
  return wire;
}

std::vector<States> SendScheduler::Everything() const {
  std::vector<WireBody> bodies;
  for (int body = 0; body < world_.body_count(); ++body) {
    if (memory_.track(body).at_rest) continue;
    bodies.push_back(Describe(body, world_.Read(body), !world_.awake(body)));
  }
  return Pack(Header(), bodies);
}

States SendScheduler::Header() const {
  States header;
  header.peer = roles_.self();
  header.tick = world_.tick();
  header.revision = world_.topology().revision();
  header.composition = static_cast<std::int64_t>(world_.composition().hash);
  return header;
}

}  // namespace seam
