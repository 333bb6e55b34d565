/// Replica, outgoing: which of its own bodies a peer tells about, and what it shows.

#include <algorithm>

#include "common/sync/replica.h"

namespace seam {
namespace {

/// Bodies per send: one datagram. More bodies than that take turns by priority.
constexpr std::size_t kBodiesPerSend = kStatesBodiesMax;
/// Growth of the accumulator per send (after Fiedler, "State Synchronization"): what just collided
/// is interesting, what sleeps is repeated seldom. A body is sent when it is among the highest.
constexpr float kPriorityImpact = 10;
constexpr float kPriorityAwake = 1;
/// Sleeping bodies are repeated this often, s: final poses arrive in spite of loss.
constexpr double kAsleepRepeat = 0.5;
/// ...and at once this many times when they fall asleep.
constexpr int kAsleepBurst = 4;

}  // namespace

States Replica::Header() const {
  States header;
  header.peer = self_;
  header.tick = tick();
  header.revision = revision();
  header.composition = static_cast<std::int64_t>(world_.composition().hash);
  return header;
}

std::vector<PackedBody> Replica::ChooseBodies() {
  std::vector<int> candidates;
  for (int body = 0; body < world_.body_count(); ++body) {
    const auto b = static_cast<std::size_t>(body);
    if (table_.at(world_.mechanism(body)).authority != self_ || !placed_[b]) continue;
    if (world_.awake(body)) {
      asleep_since_[b] = -1;
      const bool hit = tick() - last_impact_tick_[b] < config_.tick_hz;
      priority_[b] += hit ? kPriorityImpact : kPriorityAwake;
      candidates.push_back(body);
      continue;
    }
    if (asleep_since_[b] < 0) asleep_since_[b] = tick();
    const std::int64_t slept = tick() - asleep_since_[b];
    const auto repeat = static_cast<std::int64_t>(kAsleepRepeat * config_.tick_hz);
    const bool due = slept < kAsleepBurst * config_.send_every() ||
                     (slept + body) % repeat < config_.send_every();
    if (due) {
      priority_[b] += kPriorityAwake;
      candidates.push_back(body);
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(), [&](int a, int b) {
    return priority_[static_cast<std::size_t>(a)] > priority_[static_cast<std::size_t>(b)];
  });
  if (candidates.size() > kBodiesPerSend) candidates.resize(kBodiesPerSend);
  std::sort(candidates.begin(), candidates.end());

  std::vector<PackedBody> chosen;
  for (int body : candidates) {
    const auto b = static_cast<std::size_t>(body);
    priority_[b] = 0;
    PackedBody packed;
    packed.id = world_.id(body);
    packed.epoch = table_.at(world_.mechanism(body)).epoch;
    const bool awake = world_.awake(body);
    if (!awake) packed.flags |= kStateAsleep;
    if (tick() - last_impact_tick_[b] < config_.tick_hz) packed.flags |= kStateImpact;
    BodyState state = world_.Read(body);
    if (!awake) {
      state.velocity.setZero();
      state.spin = 0;
    }
    packed.state = Quantised(state);
    // At rest the sender takes what it sends, so that all peers end with the same numbers. In
    // motion it does not: writing the rounded pose back 30 times a second topples a stack of ten
    // boxes even in a world of its own (docs/architecture.md), and a receiver's error of half a
    // quantum does nothing.
    if (!awake) world_.Write(body, packed.state, false);
    chosen.push_back(packed);
  }
  return chosen;
}

std::vector<States> Replica::TakeStates() {
  std::vector<States> out;
  out.swap(outgoing_);
  return out;
}

std::vector<States> Replica::Everything() const {
  std::vector<PackedBody> bodies;
  for (int body = 0; body < world_.body_count(); ++body) {
    PackedBody packed;
    packed.id = world_.id(body);
    packed.epoch = table_.at(world_.mechanism(body)).epoch;
    packed.flags = world_.awake(body) ? std::int8_t{0} : kStateAsleep;
    packed.state = world_.Read(body);
    bodies.push_back(packed);
  }
  return Pack(Header(), bodies);
}

View Replica::MakeView() const {
  View view;
  view.peer = self_;
  view.tick = tick();
  view.revision = revision();
  for (int body = 0; body < world_.body_count(); ++body) {
    const int m = world_.mechanism(body);
    const BodyState s = world_.Read(body);
    view.id.push_back(static_cast<std::int16_t>(world_.id(body)));
    view.role.push_back(RoleOf(m));
    view.authority.push_back(static_cast<std::int16_t>(table_.at(m).authority));
    view.x.push_back(s.position.x() + smoother_.offset(body).x());
    view.y.push_back(s.position.y() + smoother_.offset(body).y());
    view.angle.push_back(s.angle + smoother_.angle_offset(body));
    view.vx.push_back(s.velocity.x());
    view.vy.push_back(s.velocity.y());
    view.spin.push_back(s.spin);
  }
  return view;
}

Impacts Replica::MakeImpacts() const {
  Impacts out;
  out.peer = self_;
  out.tick = tick();
  for (const Impact& impact : world_.impacts()) {
    if (impact.dv < kMajorImpact || out.id_a.size() >= 64) continue;
    out.id_a.push_back(
        static_cast<std::int16_t>(impact.body_a < 0 ? -1 : world_.id(impact.body_a)));
    out.id_b.push_back(
        static_cast<std::int16_t>(impact.body_b < 0 ? -1 : world_.id(impact.body_b)));
    out.x.push_back(impact.point.x());
    out.y.push_back(impact.point.y());
    out.dv.push_back(impact.dv);
  }
  return out;
}

}  // namespace seam
