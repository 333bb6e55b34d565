#include "common/sync/body_memory.h"

#include <algorithm>
#include <numeric>

namespace seam {
namespace {

/// Length of the history, s. An older state is corrected without a comparable past.
constexpr int kHistory = 3;
/// Mechanisms stay coupled for 1 s / kCoupledPart after they last touched: contact flickers.
constexpr int kCoupledPart = 4;
/// Tolerances of free fall: the change of velocity in a tick may differ from gravity's by this
/// share of it, plus this for rounding, m/s. Lying, sliding, rolling or swimming bodies differ by
/// more.
constexpr float kFallsOff = 0.05f, kFallsRounding = 1e-4f;
/// Minimum change of velocity in a tick of a thrown body, and the minimum speed at which it leaves
/// in that direction, m/s.
constexpr float kThrown = 1, kThrownSpeed = 0.5f;

}  // namespace

BodyMemory::BodyMemory(const SyncConfig& config, const World& world)
    : config_(config),
      world_(world),
      history_(world.body_count(), kHistory * config.tick_hz),
      snapshots_(world.body_count()),
      bodies_(static_cast<std::size_t>(world.body_count())),
      mechanisms_(world.composition().mechanisms.size()) {
  for (int body = 0; body < world.body_count(); ++body) snapshots_.Add(body, 0, world.Read(body));
  // In an edited initial topology the age of each body is unknown.
  for (BodyTrack& track : bodies_) track.changed_at = world.topology().revision();
  Tend();
}

const BodyState* BodyMemory::ComparablePast(int body, std::int64_t tick) const {
  if (tick < track(body).dynamic_since) return nullptr;
  return history_.At(tick, body);
}

bool BodyMemory::Coupled(int mechanism) const {
  return mechanisms_[static_cast<std::size_t>(mechanism)].last_coupled_tick >=
         world_.tick() - config_.tick_hz / kCoupledPart;
}

bool BodyMemory::Struck(int body) const {
  return world_.tick() - track(body).last_impact_tick < config_.tick_hz;
}

bool BodyMemory::FallsFreely(int body, std::int64_t tick, const BodyState& state) const {
  if (world_.Joined(body)) return false;
  const BodyState* before = ComparablePast(body, tick - 1);
  if (before == nullptr) return false;
  const Vec2 pull = world_.dt() * world_.scene().gravity;
  const Vec2 kick = state.velocity - before->velocity - pull;
  const float size = kick.norm();
  if (size <= kFallsOff * pull.norm() + kFallsRounding) return true;
  return size > kThrown && state.velocity.dot(kick) > kThrownSpeed * size;
}

BodyState BodyMemory::MovedOn(int body, std::int64_t tick) const {
  if (!snapshots_.falls(body)) return snapshots_.Extrapolate(body, tick, world_.dt(), kReckonMax);
  const std::int64_t from = snapshots_.newest_tick(body);
  return world_.AfterFlight(body, snapshots_.newest(body),
                            Snapshots::Forward(from, tick, world_.dt(), kReckonMax));
}

void BodyMemory::RecordContacts(const AuthorityTable& table) {
  for (const Impact& impact : world_.impacts()) {
    if (impact.dv < kMajorImpact) continue;
    for (const int body : {impact.body_a, impact.body_b}) {
      if (body >= 0) track(body).last_impact_tick = world_.tick();
    }
  }
  for (const Touch& touch : world_.touches()) {
    const int a = world_.mechanism(touch.body_a);
    const int b = world_.mechanism(touch.body_b);
    if (table.at(a).authority == table.at(b).authority) continue;
    mechanisms_[static_cast<std::size_t>(a)].last_coupled_tick = world_.tick();
    mechanisms_[static_cast<std::size_t>(b)].last_coupled_tick = world_.tick();
  }
}

void BodyMemory::OpenChanged() {
  changed_.clear();
  if (world_.ChangedSince(change_, &changed_)) {
    for (const int body : changed_) Open(body);
  } else {
    for (const int body : tended_) Open(body);
  }
  change_ = world_.last_change();
}

void BodyMemory::Record() {
  history_.Begin(world_.tick());
  OpenChanged();
  const int all = kHistory * config_.tick_hz;
  // A body that has lain still for the whole recorded past has the same pose at every tick.
  std::size_t left = 0;
  for (const int body : open_) {
    Noted& noted = noted_[static_cast<std::size_t>(body)];
    const std::uint64_t still = world_.still(body);
    if (still == 0 || noted.still != still) {
      noted.still = still;
      noted.ticks = 0;
    }
    if (parked(body) || noted.ticks == all) {
      noted.open = false;
      continue;
    }
    if (still != 0) ++noted.ticks;
    history_.Put(body, world_.Read(body));
    open_[left++] = body;
  }
  open_.resize(left);
}

/// Unparks all bodies and records all.
void BodyMemory::Tend() {
  parked_.assign(bodies_.size(), {});
  noted_.assign(bodies_.size(), {});
  open_.clear();
  for (std::size_t body = 0; body < bodies_.size(); ++body) Open(static_cast<int>(body));
  news_.clear();
  tended_.resize(bodies_.size());
  std::iota(tended_.begin(), tended_.end(), 0);
}

void BodyMemory::Park(int body) {
  parked_[static_cast<std::size_t>(body)] = {world_.tick(), world_.Read(body)};
  tended_.erase(std::lower_bound(tended_.begin(), tended_.end(), body));
}

void BodyMemory::FillPast(int body) {
  const Parked& parked = parked_[static_cast<std::size_t>(body)];
  const std::int64_t first = std::max(parked.since + 1, history_.oldest());
  for (std::int64_t tick = first; tick <= history_.newest(); ++tick) {
    *history_.At(tick, body) = parked.pose;
  }
}

void BodyMemory::Unpark(int body) {
  if (!parked(body)) return;
  FillPast(body);
  parked_[static_cast<std::size_t>(body)].since = -1;
  Noted& noted = noted_[static_cast<std::size_t>(body)];
  noted.still = 0;
  noted.ticks = 0;
  Open(body);
  tended_.insert(std::lower_bound(tended_.begin(), tended_.end(), body), body);
}

void BodyMemory::UnparkAll() {
  if (tended_.size() == bodies_.size()) return;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (parked(static_cast<int>(i))) FillPast(static_cast<int>(i));
  }
  Tend();
}

void BodyMemory::StartAnew() {
  for (BodyTrack& body : bodies_) body.placed = false;
  Tend();
  history_.Clear();
}

void BodyMemory::Remap(const BodyRemap& change) {
  UnparkAll();
  std::vector<BodyState> now;
  for (int body = 0; body < world_.body_count(); ++body) now.push_back(world_.Read(body));
  history_.Remap(change.bodies, now);
  snapshots_.Remap(change.bodies);

  std::vector<BodyTrack> bodies;
  for (std::size_t i = 0; i < change.bodies.size(); ++i) {
    const BodyOrigin& origin = change.bodies[i];
    bodies.push_back(origin.body < 0 ? BodyTrack{} : track(origin.body));
    if (origin.body >= 0 && origin.same) continue;
    BodyTrack& changed = bodies.back();
    changed.changed_at = world_.topology().revision();
    // Our body now and the authority's body then are different: no comparison until both are the
    // same.
    changed.dynamic_since = world_.tick();
    changed.pull = PullTrack{};
    changed.asleep_since = -1;
    const int body = static_cast<int>(i);
    snapshots_.ForgetAfter(body, world_.tick());
    if (!snapshots_.has(body)) snapshots_.Add(body, world_.tick(), now[i]);
    if (BodyState* past = history_.At(world_.tick(), body)) *past = now[i];
  }
  bodies_ = std::move(bodies);
  Tend();

  std::vector<MechanismTrack> mechanisms;
  for (const std::vector<int>& from : change.mechanisms) {
    MechanismTrack joined;
    for (const int then : from) {
      joined.last_coupled_tick = std::max(
          joined.last_coupled_tick, mechanisms_[static_cast<std::size_t>(then)].last_coupled_tick);
    }
    mechanisms.push_back(joined);
  }
  mechanisms_ = std::move(mechanisms);
}

}  // namespace seam
