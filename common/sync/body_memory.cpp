#include "common/sync/body_memory.h"

#include <algorithm>
#include <numeric>

#include "common/scene/saved/persist_state.h"

namespace seam {
namespace {

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

BodyMemory::BodyMemory(const SyncConfig& config, const World& world, const BodyTable& table)
    : config_(config),
      world_(world),
      table_(table),
      history_(table, kHistory * config.tick_hz, [&world](int body) { return world.Read(body); }),
      snapshots_(table),
      bodies_(table, [this](int, const BodyOrigin& origin,
                            BodyTrack* before) { return AfterEdit(origin, before); }),
      mechanisms_(table,
                  [](const MechanismTrack& before, MechanismTrack* track) {
                    track->last_coupled_tick =
                        std::max(track->last_coupled_tick, before.last_coupled_tick);
                  }),
      noted_(table, BodyRule::kFresh),
      parked_since_(table, BodyRule::kFresh, -1),
      edited_(table, [this](const BodyRemap& change) { Edited(change); }) {
  for (int body = 0; body < world.body_count(); ++body) snapshots_.Add(body, 0, world.Read(body));
  // In an edited initial topology the age of each body is unknown.
  for (BodyTrack& track : bodies_) track.changed_at = world.topology().revision();
  Restart();
}

const BodyState* BodyMemory::ComparablePast(int body, std::int64_t tick) const {
  if (tick < track(body).dynamic_since) return nullptr;
  return history_.At(tick, body);
}

bool BodyMemory::Coupled(int mechanism) const {
  return mechanisms_[mechanism].last_coupled_tick >= world_.tick() - config_.tick_hz / kCoupledPart;
}

void BodyMemory::NoteDiffering(int mechanism) {
  MechanismTrack& track = mechanisms_[mechanism];
  if (world_.tick() - track.differed_tick < RefreshEvery(config_.tick_hz)) return;
  track.differed_tick = world_.tick();
  differing_.push_back(world_.composition().mechanisms[static_cast<std::size_t>(mechanism)].id);
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
    mechanisms_[a].last_coupled_tick = world_.tick();
    mechanisms_[b].last_coupled_tick = world_.tick();
  }
}

void BodyMemory::OpenChanged() {
  changed_.clear();
  if (world_.ChangedSince(change_, &changed_)) {
    for (const int body : changed_) Open(body);
  } else {
    for (const int body : unparked_) Open(body);
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
    Noted& noted = noted_[body];
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

/// Records all bodies from now on.
void BodyMemory::Restart() {
  noted_.Reset();
  open_.clear();
  for (int body = 0; body < table_.bodies(); ++body) Open(body);
  news_.clear();
  unparked_.resize(static_cast<std::size_t>(table_.bodies()));
  std::iota(unparked_.begin(), unparked_.end(), 0);
}

void BodyMemory::Park(int body) {
  parked_since_[body] = world_.tick();
  unparked_.erase(std::lower_bound(unparked_.begin(), unparked_.end(), body));
}

void BodyMemory::FillPast(int body) {
  const BodyState pose = world_.Read(body);
  const std::int64_t first = std::max(parked_since_[body] + 1, history_.oldest());
  for (std::int64_t tick = first; tick <= history_.newest(); ++tick) {
    *history_.At(tick, body) = pose;
  }
}

void BodyMemory::Unpark(int body) {
  FillPast(body);
  Noted& noted = noted_[body];
  noted.still = 0;
  noted.ticks = 0;
  Open(body);
  unparked_.insert(std::lower_bound(unparked_.begin(), unparked_.end(), body), body);
}

void BodyMemory::UnparkAll() {
  for (int body = 0; body < table_.bodies(); ++body) {
    if (parked(body)) FillPast(body);
  }
  Restart();
}

void BodyMemory::StartAnew() {
  for (BodyTrack& body : bodies_) body.placed = false;
  Restart();
  history_.Clear();
}

BodyTrack BodyMemory::AfterEdit(const BodyOrigin& origin, const BodyTrack* before) const {
  BodyTrack track = before == nullptr ? BodyTrack{} : *before;
  if (origin.same) return track;
  track.changed_at = world_.topology().revision();
  // Our body now and the authority's body then are different: no comparison until both are the
  // same.
  track.dynamic_since = world_.tick();
  track.pull = PullTrack{};
  track.asleep_since = -1;
  return track;
}

void BodyMemory::Edited(const BodyRemap& change) {
  for (int body = 0; body < table_.bodies(); ++body) {
    if (change.bodies[static_cast<std::size_t>(body)].same) continue;
    const BodyState now = world_.Read(body);
    snapshots_.ForgetAfter(body, world_.tick());
    if (!snapshots_.has(body)) snapshots_.Add(body, world_.tick(), now);
    if (BodyState* past = history_.At(world_.tick(), body)) *past = now;
  }
  Restart();
}

void BodyMemory::Persist(StateArchive& a) {
  a.Section("bodies");
  if (a.reading()) {
    StartAnew();
    for (int body = 0; body < world_.body_count(); ++body) {
      snapshots_.ForgetAfter(body, -1);
      snapshots_.Add(body, world_.tick(), world_.Read(body));
    }
    Record();
  }
  a.Exactly(&bodies_, [&](BodyTrack* track) {
    a.Tick(&track->last_impact_tick);
    a.Tick(&track->heard_tick);
    a.Int(&track->heard_epoch, 0, INT32_MAX);
    a.Tick(&track->dynamic_since);
    a.Flag(&track->placed);
    a.Real(&track->priority);
    a.Tick(&track->asleep_since);
    a.Tick(&track->sent_tick);
    a.Int(&track->sent_epoch, -1, INT32_MAX);
    a.Tick(&track->told_tick);
    a.Int(&track->changed_at, 0, world_.topology().revision());
    a.Flag(&track->at_rest);
    a.Tick(&track->pull.arrived);
    seam::Persist(a, &track->pull.memory.before, kSavedSpeedMost);
    seam::Persist(a, &track->pull.memory.asked, kSavedSpeedMost);
    a.Real(&track->pull.memory.share);
  });
  a.Exactly(&mechanisms_, [&](MechanismTrack* track) {
    a.Tick(&track->last_coupled_tick);
    a.Tick(&track->unsettled_until);
    a.Tick(&track->differed_tick);
  });
}

std::vector<char> BodyMemory::Still() const {
  std::vector<char> all(static_cast<std::size_t>(table_.bodies()), 0);
  for (int body = 0; body < table_.bodies(); ++body) {
    const Noted& noted = noted_[body];
    const bool whole = noted.ticks == kHistory * config_.tick_hz && noted.still != 0;
    all[static_cast<std::size_t>(body)] = whole && noted.still == world_.still(body) ? 1 : 0;
  }
  return all;
}

void BodyMemory::PersistPast(StateArchive& a, std::int64_t from, const std::vector<char>& still) {
  history_.Persist(a, from, [&](int body) { return still[static_cast<std::size_t>(body)] != 0; });
  a.Require(history_.newest() == world_.tick(), "it ends at another tick");
  a.Section("heard");
  for (int body = 0; a.ok() && body < table_.bodies(); ++body) snapshots_.Persist(a, body, from);
}

}  // namespace seam
