#include "server/trust/plausible.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/physics/part_places.h"
#include "common/scene/character.h"
#include "common/scene/mechanism_ids.h"
#include "common/sync/reach/zones.h"
#include "common/sync/state_arithmetic.h"
#include "server/rules/impact_check.h"

namespace seam {
namespace {

/// Distance from a body's centre at which a difference of angles is felt, m.
constexpr float kArm = 0.5f;
/// Differences above these are gross, m and m/s, and weigh kGrossWeight as much.
constexpr float kGross = 1, kGrossVelocity = 5, kGrossWeight = 4;
/// A difference told for this time weighs 1, s: the time between two states of a holder whose
/// copies agree.
constexpr float kWeighedS = 0.25f;
/// Distance of a place from the way that the told velocities explain, m. Bots in collisions over
/// every network: at most .48 m in a gap of .27 s.
constexpr float kWaySlack = 0.6f;
/// After a longer silence the server's own copy is the reference, s. A copy that does not come to
/// the holder's state by itself knows nothing of what the body met: it is the reference only beyond
/// a holder's lease.
constexpr float kWayMaxS = 0.5f, kUnseenWayMaxS = 2;
/// Time after an edit in which differences that are not gross say nothing, s: as long as every send
/// has the states of what an edit has changed.
constexpr float kSettlesS = 1;
/// Differences that say nothing, by those of exact copies, where copies follow told states. In
/// `crossing` with a part made or removed three times a second, over demo: up to 12 mm, .12 m/s.
constexpr float kRoughTimes = 3;
/// Distance at which an edit may reach a body in that time though nothing near it is fast, m.
constexpr float kEditReach = 10;
/// Speed at which a body may be thrown to and fro where nobody sees it, m/s.
constexpr float kCollisionVelocity = 5;

/// Distance of a point from the segment between two others.
float DistanceFrom(const Vec2& point, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const float length = along.squaredNorm();
  const float share = length > 0 ? std::clamp((point - a).dot(along) / length, 0.0f, 1.0f) : 0;
  return (point - a - share * along).norm();
}

/// A character's step is no part of its states: a copy that follows told states lacks it.
bool IsOfCharacter(const World& world, int body) {
  const auto& all = world.scene().characters;
  return std::any_of(all.begin(), all.end(), [&](const Character& character) {
    return MechanismOf(world, character.parts[kTorso]) == world.mechanism(body);
  });
}

/// Returns the moving body that has the part; -1 for none.
int BodyOf(const World& world, PartId part) {
  const Composition& made = world.composition();
  const auto index = static_cast<std::size_t>(part);
  const int its = index < made.assembly_of_part.size() ? made.assembly_of_part[index] : -1;
  return its < 0 ? -1 : world.BodyOfId(made.assemblies[static_cast<std::size_t>(its)].id);
}

float Way(const BodyState& off) { return off.position.norm() + kArm * std::fabs(off.angle); }
float Kick(const BodyState& off) { return off.velocity.norm() + kArm * std::fabs(off.spin); }

}  // namespace

Plausible::Plausible(const Scene& scene, const Replica& replica)
    : scene_(scene),
      replica_(replica),
      accepted_(replica.table(), BodyRule::kSame),
      memory_(replica.table(), BodyRule::kOrigin),
      strikers_(replica.world(), [this](int body) { return SpeedOfLate(body); }),
      drift_(replica),
      note_begun_(replica.table(), [this](const BodyRemap& change) { NoteBegun(change); }) {
  parts_ = replica.world().scene().parts.size();
  for (int body = 0; body < memory_.size(); ++body) NoteBegun(body);
}

void Plausible::NoteBegun(int body) {
  memory_[body].began = replica_.world().tick();
  memory_[body].first = replica_.world().Read(body);
}

/// A body that an edit has made begins where it is in the server's world.
void Plausible::NoteBegun(const BodyRemap& change) {
  for (int body = 0; body < memory_.size(); ++body) {
    if (!change.bodies[static_cast<std::size_t>(body)].same) NoteBegun(body);
  }
  Box inserted;
  float speed = 0;
  const std::size_t parts = replica_.world().scene().parts.size();
  for (std::size_t p = parts_; p < parts; ++p) {
    AddMechanism(static_cast<PartId>(p), &inserted, &speed);
  }
  parts_ = parts;
  if (!inserted.isEmpty()) NoteChanged(inserted, speed);
}

void Plausible::NoteSpeed(int body, std::int64_t tick, float speed) {
  Memory& memory = memory_[body];
  if (speed < memory.fast && Seconds(tick - memory.fast_tick) < Strikers::kSeconds) return;
  memory.fast = speed;
  memory.fast_tick = tick;
}

float Plausible::SpeedOfLate(int body) const {
  const Memory& memory = memory_[body];
  return std::max(memory.fast, replica_.world().Read(body).velocity.norm()) +
         PushedSince(body, accepted_[body].tick);
}

float Plausible::Seconds(std::int64_t ticks) const {
  return static_cast<float>(ticks) * replica_.world().dt();
}

bool Plausible::Waits(const States& states) const {
  const World& world = replica_.world();
  return std::any_of(states.id.begin(), states.id.end(), [&](std::int32_t id) {
    const int body = world.BodyOfId(id);
    const bool copied = body >= 0 && world.activity(body) == Activity::kSimulated &&
                        replica_.CopiesAgree(world.mechanism(body)) &&
                        replica_.SameBody(body, states.revision);
    return copied && replica_.SettledPast(body, states.tick) == nullptr;
  });
}

bool Plausible::Reachable(int body, std::int64_t tick, const Vec2& position, float times) const {
  const Accepted& last = accepted_[body];
  if (last.tick < 0) return true;
  const float way =
      times * scene_.speed_limit * Seconds(std::max<std::int64_t>(1, tick - last.tick));
  return (position - last.state.position).norm() <= way;
}

void Plausible::NoteDoubt(int body, std::int64_t tick, const BodyState& told,
                          const BodyState& expected, bool refused, bool guessed) {
  const Memory& memory = memory_[body];
  const BodyState off = Minus(told, expected);
  const float silence = memory.judged < 0 ? kWeighedS : Seconds(tick - memory.judged);
  const bool gross = Way(off) > kGross || Kick(off) > kGrossVelocity;
  const float weight = std::clamp(silence / kWeighedS, 0.0f, 1.0f) * (gross ? kGrossWeight : 1);
  ++counts_.doubted;
  counts_.refused += refused ? 1 : 0;
  const DoubtKind kind = refused ? DoubtKind::kRefused : DoubtKind::kSmall;
  doubts_.push_back({kind, body, tick, told, expected, weight, guessed});
}

bool Plausible::Judge(int body, std::int64_t tick, int revision, const BodyState& state,
                      bool whole) {
  const BodyState* const copy = replica_.ComparablePast(body, tick, revision);
  bool believed = false;
  ++counts_.judged;
  counts_.by_copy += copy != nullptr ? 1 : 0;
  if (copy != nullptr) {
    BodyState off = Minus(state, *copy);
    off.angle = WrapAngle(off.angle);
    if (!whole) off.velocity = Vec2(0, 0), off.spin = 0;
    if (whole && !Settles(body) && !replica_.FollowsTold()) drift_.Add(body, tick, *copy, off);
    believed = JudgeByCopy(body, tick, state, off);
  } else {
    believed = JudgeByWay(body, tick, revision, state, whole);
  }
  Memory& memory = memory_[body];
  memory.judged = std::max(memory.judged, tick);
  memory.probation = believed ? 0 : 1;
  if (believed && whole) NoteSpeed(body, tick, state.velocity.norm());
  return believed;
}

/// A holder that has not applied an edit yet, or has just gone back for it, differs.
bool Plausible::Settles(int body) const {
  return Seconds(replica_.tick() - memory_[body].edited) < kSettlesS;
}

void Plausible::NoteEdit(const Edit& edit) {
  const World& world = replica_.world();
  parts_ = world.scene().parts.size();
  Box box;
  float speed = 0;
  for (const PartId part : world.topology().PartsOf(edit)) AddMechanism(part, &box, &speed);
  const SeatEdit* const seat = edit.As<SeatEdit>();
  if (seat != nullptr && static_cast<std::size_t>(seat->seat) < world.scene().seats.size()) {
    AddMechanism(world.scene().seats[static_cast<std::size_t>(seat->seat)].part, &box, &speed);
  }
  const PushEdit* const push = edit.As<PushEdit>();
  const int pushed = push != nullptr ? BodyOf(world, push->part) : -1;
  if (pushed >= 0) NotePushed(pushed, push->impulse.norm() / world.mass(pushed));
  if (const BlastEdit* const blast = edit.As<BlastEdit>()) {
    const Vec2 reach = Vec2::Constant(blast->radius);
    const Box hit(blast->centre - reach, blast->centre + reach);
    box.extend(hit);
    NoteBlast(*blast, hit);
  }
  if (!box.isEmpty()) NoteChanged(box, speed);
}

void Plausible::NoteBlast(const BlastEdit& blast, const Box& hit) {
  const World& world = replica_.world();
  const Composition& made = world.composition();
  for (int body = 0; body < world.body_count(); ++body) {
    const int its = made.assembly_of_part[static_cast<std::size_t>(world.id(body))];
    const float extent = ExtentOf(world, made.assemblies[static_cast<std::size_t>(its)]);
    if (hit.exteriorDistance(world.Read(body).position) > extent) continue;
    const float most = 2 * extent * blast.impulse / world.mass(body);
    NotePushed(body, std::min(most, scene_.speed_limit));
  }
}

void Plausible::NotePushed(int body, float speed) {
  const World& world = replica_.world();
  EachIdOf(world.composition(), world.mechanism(body), [&](PartId id) {
    const int other = world.BodyOfId(id);
    Memory& memory = memory_[other];
    if (accepted_[other].tick >= memory.pushed_tick) memory.pushed = 0;
    memory.pushed += speed;
    memory.pushed_tick = world.tick();
  });
}

float Plausible::PushedSince(int body, std::int64_t tick) const {
  const Memory& memory = memory_[body];
  return tick <= memory.pushed_tick ? memory.pushed : 0;
}

/// Adds where the part's mechanism is: an edit of one end reaches the other at once.
void Plausible::AddMechanism(PartId part, Box* box, float* speed) const {
  const World& world = replica_.world();
  const Composition& made = world.composition();
  const auto index = static_cast<std::size_t>(part);
  const int its = index < made.assembly_of_part.size() ? made.assembly_of_part[index] : -1;
  if (its < 0) return;
  const Assembly& assembly = made.assemblies[static_cast<std::size_t>(its)];
  const Vec2 extent = Vec2::Constant(ExtentOf(world, assembly));
  const Vec2 place = world.ReadAssembly(its).position;
  box->extend(Box(place - extent, place + extent));
  const int body = world.BodyOfId(assembly.id);
  if (body < 0) return;
  EachIdOf(made, world.mechanism(body), [&](PartId id) {
    const int other = world.BodyOfId(id);
    box->extend(world.Read(other).position);
    *speed = std::max(*speed, SpeedOfLate(other));
  });
}

void Plausible::NoteChanged(const Box& box, float speed) {
  const World& world = replica_.world();
  for (int body = 0; body < memory_.size(); ++body) {
    const float reach = kEditReach + kSettlesS * (speed + SpeedOfLate(body));
    if (box.exteriorDistance(world.Read(body).position) > reach) continue;
    memory_[body].edited = world.tick();
  }
}

bool Plausible::Believe(int body, float way, float kick) {
  Memory& memory = memory_[body];
  const float forgotten = std::min(
      1.0f, Seconds(std::max<std::int64_t>(0, replica_.tick() - memory.forgotten)) / kForgetS);
  memory.forgotten = replica_.tick();
  memory.moved = std::max(0.0f, memory.moved - forgotten * kAllowed);
  memory.kicked = std::max(0.0f, memory.kicked - forgotten * kAllowedVelocity);
  if (memory.moved + way > kAllowed || memory.kicked + kick > kAllowedVelocity) return false;
  memory.moved += way;
  memory.kicked += kick;
  return true;
}

bool Plausible::JudgeByCopy(int body, std::int64_t tick, const BodyState& state, BodyState off) {
  const float way = Way(off), kick = Kick(off);
  const bool rough = replica_.FollowsTold();
  const float times = rough ? kRoughTimes : 1;
  if (way <= times * kAgrees && kick <= times * kAlikeVelocity) {
    if (!rough && drift_.Lies(body)) NoteDoubt(body, tick, state, Minus(state, off), false);
    return true;
  }
  if (Settles(body) && way <= kGross && kick <= kGrossVelocity) return true;
  const bool believed = Believe(body, way, kick);
  if (believed && rough) return true;
  NoteDoubt(body, tick, state, Minus(state, off), !believed,
            rough && IsOfCharacter(replica_.world(), body));
  return believed;
}

/// The way since the last accepted state is explained by a change of velocity at one moment
/// between: it ends on the segment between the two velocities times the time. The told velocity
/// counts as far as drives, collisions and edits explain it; where the server has a copy, which the
/// state moves, more is believed as far as it would be beside that copy. A body
/// that was silent for long is where the server last had it, or has moved on from there as far as
/// lost messages explain.
bool Plausible::JudgeByWay(int body, std::int64_t tick, int revision, const BodyState& state,
                           bool whole) {
  const World& world = replica_.world();
  const Memory& memory = memory_[body];
  Accepted last = accepted_[body];
  if (last.tick < memory.began) last.tick = memory.began, last.state = memory.first;
  const bool simulated =
      world.activity(body) == Activity::kSimulated && replica_.CopiesAgree(world.mechanism(body));
  const bool guessed = simulated && replica_.EditHidesPast(body, tick, revision);
  const bool copied = simulated && !guessed;
  const float longest = copied ? kWayMaxS : kUnseenWayMaxS;
  const bool known = last.tick >= 0 && Seconds(tick - last.tick) <= longest && tick >= last.tick;
  const BodyState from = known ? last.state : world.Read(body);
  float seconds = std::fabs(Seconds(tick - (known ? last.tick : world.tick())));
  if (!known && !copied) seconds = std::max(seconds, kWayMaxS);
  const float driven = kDrivenAcceleration + scene_.gravity.norm();
  const float pushed = PushedSince(body, known ? last.tick : world.tick());
  Vec2 told = whole ? state.velocity : from.velocity;
  const float speed = told.norm();
  float explained = from.velocity.norm() + driven * seconds + pushed;
  if (speed > explained) explained += strikers_.AddedSpeed(body);
  // Who has no copy knows nothing of what the body met.
  const float most = explained + (simulated ? 0 : kCollisionVelocity);
  if (speed > most) told *= most / speed;
  float slack = kWaySlack + pushed * seconds + driven * seconds * seconds / 2;
  // It may have met anything, and been thrown to and fro.
  if (!copied) slack += std::max(kCollisionVelocity, from.velocity.norm()) * seconds;
  const Vec2 way = state.position - from.position;
  const auto off = [&](float s) { return DistanceFrom(way, s * from.velocity, s * told); };
  // A copy of now may be ahead of the told tick or behind it.
  const bool reached = off(seconds) <= slack || (!known && off(-seconds) <= slack);
  if (reached && (!simulated || speed <= explained || Believe(body, 0, speed - explained))) {
    return true;
  }
  NoteDoubt(body, tick, state, from, true, guessed);
  return false;
}

}  // namespace seam
