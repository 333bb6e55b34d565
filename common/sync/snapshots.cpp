#include "common/sync/snapshots.h"

#include <algorithm>
#include <utility>

#include "common/base/check.h"
#include "common/base/geometry.h"
#include "common/scene/saved/persist_state.h"
#include "common/sync/quantize.h"
#include "common/sync/state_arithmetic.h"

namespace seam {
namespace {

/// Acceleration common to the last two intervals between states is assumed to last for
/// kAccelerationLasts, unless it exceeds that of gravity, brakes and drag, or the states are far
/// apart. s, m/s^2, s
constexpr float kAccelerationLasts = 0.3f, kAccelerationMax = 30, kAccelerationSpan = 0.5f;
constexpr std::size_t kKeptStates = 96;   // states per body: about three seconds
constexpr std::int64_t kKeptTicks = 512;  // ...and none older than this

/// Returns the shortest vector on the segment from `a` to `b`: equal to both if they agree, 0 if
/// they oppose each other or one is 0.
Vec2 LeastBetween(const Vec2& a, const Vec2& b) {
  const Vec2 way = b - a;
  const float length = way.squaredNorm();
  return length > 0 ? Vec2(a + std::clamp(-a.dot(way) / length, 0.0f, 1.0f) * way) : a;
}

/// True if the velocities of two states differ by what gravity adds in between, `pull`, within the
/// rounding of the wire.
bool FellBetween(const BodyState& before, const BodyState& after, const Vec2& pull) {
  const float off = (after.velocity - before.velocity - pull).norm();
  return off < 2 * kVelocityQuantum;
}

/// Returns the time after `a`, s, at which its straight path is nearest to that of `b`, which is
/// `whole` s later; the whole time if they are parallel.
float MeetingTime(const BodyState& a, const BodyState& b, float whole) {
  const Vec2 apart = b.position - whole * b.velocity - a.position;
  const Vec2 parting = b.velocity - a.velocity;
  const float speed = parting.norm();
  if (speed < 2 * kVelocityQuantum) return whole;
  return std::clamp(-apart.dot(parting) / (speed * speed), 0.0f, whole);
}

}  // namespace

Vec2 SpeedGained(const Vec2& acceleration, float forward) {
  return acceleration * std::min(forward, kAccelerationLasts);
}

Vec2 ShiftGained(const Vec2& acceleration, float forward) {
  const float lasts = std::min(forward, kAccelerationLasts);
  return acceleration * (lasts * (forward - lasts / 2));
}

Snapshots::Snapshots(const BodyTable& table)
    : rings_(table, [](int, const BodyOrigin& origin, Ring* before) {
        return AfterEdit(origin, before);
      }) {}

void Snapshots::Ring::Push(const Stamped& stamped) {
  const bool needed = size_ == 0 || FromNewest(size_ - 1u).tick > stamped.tick - kKeptTicks;
  if (size_ == slots_.size() && size_ < kKeptStates && needed) Grow();
  slots_[next_] = stamped;
  next_ = next_ + 1u == slots_.size() ? std::uint16_t{0} : static_cast<std::uint16_t>(next_ + 1);
  size_ = static_cast<std::uint16_t>(std::min(size_ + std::size_t{1}, slots_.size()));
  newest_tick_ = stamped.tick;
  newest_ = stamped.state;
}

void Snapshots::Ring::DropNewest() {
  next_ = static_cast<std::uint16_t>((next_ == 0 ? slots_.size() : next_) - 1);
  --size_;
  falls = false;  // not stored for older states
  newest_tick_ = size_ == 0 ? -1 : FromNewest(0).tick;
  if (size_ > 0) newest_ = FromNewest(0).state;
}

void Snapshots::Ring::Grow() {
  constexpr std::size_t kFirst = 6;
  std::vector<Stamped> slots(slots_.empty() ? kFirst : std::min(2 * slots_.size(), kKeptStates));
  for (std::size_t i = 0; i < size_; ++i) slots[i] = FromNewest(size_ - 1 - i);
  slots_ = std::move(slots);
  next_ = size_;
}

void Snapshots::Add(int body, std::int64_t tick, const BodyState& state, bool falls) {
  Ring& ring = rings_[body];
  if (ring.size() != 0 && ring.newest_tick() >= tick) return;
  ring.Push({tick, state});
  ring.falls = falls;
}

Snapshots::Ring Snapshots::AfterEdit(const BodyOrigin& origin, Ring* before) {
  if (before == nullptr) return Ring();
  if (origin.same) return std::move(*before);
  Ring ring = *before;
  ring.Change([&](const BodyState& state) { return Carried(origin, state); });
  ring.falls = false;
  return ring;
}

void Snapshots::ForgetAfter(int body, std::int64_t tick) {
  Ring& ring = rings_[body];
  while (ring.size() > 0 && ring.newest_tick() > tick) ring.DropNewest();
}

void Snapshots::Persist(StateArchive& a, int body, std::int64_t from) {
  Ring& ring = rings_[body];
  std::vector<Stamped> states;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    states.push_back(ring.FromNewest(k));
    if (states.back().tick < from) break;
  }
  std::reverse(states.begin(), states.end());
  bool falls = ring.falls;
  a.List(&states, kKeptStates, [&](Stamped* each) {
    a.Int(&each->tick, 0, StateArchive::kTickMost);
    PersistStates(a, &each->state, 1);
  });
  a.Flag(&falls);
  if (!a.reading()) return;
  ring = Ring();
  for (const Stamped& each : states) Add(body, each.tick, each.state);
  ring.falls = falls;
}

const BodyState* Snapshots::At(int body, std::int64_t tick) const {
  const Ring& ring = rings_[body];
  for (std::size_t k = 0; k < ring.size() && ring.FromNewest(k).tick >= tick; ++k) {
    if (ring.FromNewest(k).tick == tick) return &ring.FromNewest(k).state;
  }
  return nullptr;
}

BodyState Snapshots::Interpolate(int body, double tick, float dt, const Vec2& gravity,
                                 bool alone) const {
  const Ring& ring = rings_[body];
  SEAM_ASSERT(ring.size() > 0);
  if (tick >= static_cast<double>(ring.newest_tick())) return ring.newest();
  for (std::size_t k = 1; k < ring.size(); ++k) {
    const Stamped& a = ring.FromNewest(k);
    if (static_cast<double>(a.tick) > tick) continue;
    const Stamped& b = ring.FromNewest(k - 1);
    const float whole = static_cast<float>(b.tick - a.tick) * dt;
    const float since = static_cast<float>(tick - static_cast<double>(a.tick)) * dt;
    const bool fell = FellBetween(a.state, b.state, whole * gravity);
    const float turned = fell || !alone ? whole : MeetingTime(a.state, b.state, whole);
    BodyState left =
        Minus(seam::Extrapolate(b.state, turned - whole), seam::Extrapolate(a.state, turned));
    left.angle = WrapAngle(left.angle);
    const BodyState& near = since < turned ? a.state : b.state;
    const float by = since < turned ? since : since - whole;
    BodyState out = PlusScaled(seam::Extrapolate(near, by), left, by / whole);
    if (fell) out.position += (since * (since - whole) / 2) * gravity;
    return out;
  }
  return ring.FromNewest(ring.size() - 1).state;
}

float Snapshots::Forward(std::int64_t from, std::int64_t tick, float dt, float max_s) {
  return std::min(static_cast<float>(std::max<std::int64_t>(0, tick - from)) * dt, max_s);
}

Vec2 Snapshots::AccelerationBefore(std::size_t back, const Ring& ring, float dt) {
  if (ring.size() < back + 2) return {0, 0};
  const Stamped &after = ring.FromNewest(back), &before = ring.FromNewest(back + 1);
  const float between = static_cast<float>(after.tick - before.tick) * dt;
  const Vec2 acceleration = (after.state.velocity - before.state.velocity) / between;
  const bool lasts = between <= kAccelerationSpan && acceleration.norm() <= kAccelerationMax;
  return lasts ? acceleration : Vec2(0, 0);
}

Vec2 Snapshots::Acceleration(int body, std::int64_t tick, float dt) const {
  const Ring& ring = rings_[body];
  if (ring.newest_tick() != tick) return {0, 0};
  // A start, a stop or an impact changes the velocity once: that does not last.
  return LeastBetween(AccelerationBefore(0, ring, dt), AccelerationBefore(1, ring, dt));
}

BodyState Snapshots::Onward(const Ring& ring, std::int64_t tick, float dt, float max_s,
                            const Vec2& acceleration) {
  SEAM_ASSERT(ring.size() > 0);
  const float forward = Forward(ring.newest_tick(), tick, dt, max_s);
  BodyState out = seam::Extrapolate(ring.newest(), forward);
  out.velocity += SpeedGained(acceleration, forward);
  out.position += ShiftGained(acceleration, forward);
  return out;
}

BodyState Snapshots::Extrapolate(int body, std::int64_t tick, float dt, float max_s) const {
  const Ring& ring = rings_[body];
  return Onward(ring, tick, dt, max_s, Acceleration(body, ring.newest_tick(), dt));
}

BodyState Snapshots::ExtrapolateNewest(int body, std::int64_t tick, float dt, float max_s) const {
  const Ring& ring = rings_[body];
  return Onward(ring, tick, dt, max_s, AccelerationBefore(0, ring, dt));
}

}  // namespace seam
