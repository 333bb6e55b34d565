/// Corrector: hand-over of a mechanism. Its holder sends its exact states of the tick of release;
/// copies are put there at that tick and moved on to now.

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/sync/correct/corrector.h"
#include "common/sync/reach/way_to.h"
#include "common/sync/state_limits.h"

namespace seam {
namespace {

/// Where no replay can take over the holder's state, it or its difference from the copy is
/// extrapolated by at most this, s: beyond that, walls and impacts may lie on the way. Reliable
/// messages queue when many mechanisms change hands, and with rollback the states are of an
/// input-complete tick, which may be seconds ago.
constexpr float kReckonedFor = 0.25f;

BodyState StateOf(const ExactStates& exact, std::size_t i) {
  return {{exact.x[i], exact.y[i]}, exact.angle[i], {exact.vx[i], exact.vy[i]}, exact.spin[i]};
}

/// Extrapolates a difference by its velocity for `seconds`.
BodyState MovedOn(BodyState difference, float seconds) {
  difference.position += seconds * difference.velocity;
  difference.angle += seconds * difference.spin;
  return difference;
}

}  // namespace

BodyState Corrector::TakeOver(const ExactStates& exact) {
  BodyState largest;
  const std::int64_t now = world_.tick();
  bool replays = false;
  for (std::size_t i = 0; i < exact.id.size(); ++i) {
    const int body = world_.BodyOfId(exact.id[i]);
    if (body < 0 || exact.revision < memory_.track(body).changed_at) continue;
    BodyTrack& track = memory_.track(body);
    const AuthorityRecord& record = roles_.table().at(world_.mechanism(body));
    // It precedes the grant that results from it; after older changes it is stale.
    const bool ours = record.authority == roles_.self() && roles_.self() != 0;
    if (ours || exact.epoch[i] < record.epoch || exact.tick < track.heard_tick) continue;
    BodyState there = WithinLimits(StateOf(exact, i), world_.scene().speed_limit);
    if (!track.placed) memory_.snapshots().ForgetAfter(body, exact.tick - 1);
    const bool falls = memory_.snapshots().has(body) && memory_.snapshots().falls(body);
    memory_.snapshots().Add(body, exact.tick, there, falls);
    track.heard_tick = exact.tick;
    track.heard_epoch = exact.epoch[i];
    memory_.MarkUpdated(body);
    if (!track.placed) {  // without this, no peer would know the pose of a body that becomes ours
      PlaceNow(body, exact.tick, there, false);
      continue;
    }
    if (world_.activity(body) != Activity::kSimulated) continue;
    const std::int64_t from = std::min(exact.tick, now);
    const BodyState* then = memory_.ComparablePast(body, from);
    const float late = static_cast<float>(now - exact.tick) * world_.dt();
    if (then == nullptr && late > kReckonedFor) {
      BringBack(body, there, exact.tick);
      continue;
    }
    const BodyState told = there;
    // Without a past, the holder's own motion gives its current place.
    const BodyState here = then != nullptr ? *then : world_.Read(body);
    if (then == nullptr || exact.tick > now) there = MovedOn(there, late);
    there.angle = UnwrapAngle(there.angle, here.angle);
    const BodyState difference = Minus(there, here);
    if (difference.position.norm() > largest.position.norm())
      largest.position = difference.position;
    if (difference.velocity.norm() > largest.velocity.norm())
      largest.velocity = difference.velocity;
    if (then != nullptr && exact.tick <= now && replay_.Ask(body, from)) {
      replays = true;
    } else if (late > kReckonedFor && config_.policy->GoesBack(roles_.self())) {
      BringBack(body, told, exact.tick);  // newer states are under way
    } else if (!memory_.Coupled(world_.mechanism(body))) {
      ApplyDifference(body, then != nullptr ? from : now, difference, told, exact.tick);
    } else {
      // Two authorities press on the body: the whole difference would push it into one of them. The
      // rule goes on correcting instead.
      BringBack(body, told, exact.tick);
    }
  }
  // At once: the next grant makes bodies our own, and a replay corrects only copies.
  if (replays) replay_.Run();
  return largest;
}

/// Brings a copy back across an anchored shape if its holder had it on the other side. Once this
/// peer has the authority, the body would stay there.
void Corrector::BringBack(int body, const BodyState& told, std::int64_t tick) {
  const BodyState here = world_.Read(body);
  BodyState back = here;
  back.position = WayTo(world_, memory_, body, told.position, tick, here.position);
  if (back.position == here.position) return;
  back.velocity = told.velocity;
  back.spin = told.spin;
  world_.Write(body, back);
  if (BodyState* past = memory_.history().At(world_.tick(), body)) *past = back;
  display_.Moved(body, Minus(back, here));
}

/// Adds the difference at tick `from` to the copy, at that tick and since. `told`: the holder's
/// state at tick `told_tick`.
void Corrector::ApplyDifference(int body, std::int64_t from, const BodyState& difference,
                                const BodyState& told, std::int64_t told_tick) {
  const std::int64_t now = world_.tick();
  BodyState off = difference;
  // A later impact here has cancelled a difference of velocity.
  if (memory_.track(body).last_impact_tick > from) {
    off.velocity.setZero();
    off.spin = 0;
  }
  const BodyState local = world_.Read(body);
  const float seconds = static_cast<float>(now - from) * world_.dt();
  BodyState moved = PlusScaled(local, MovedOn(off, seconds), 1);
  moved.position = WayTo(world_, memory_, body, told.position, told_tick, moved.position);
  for (std::int64_t t = from; t < now; ++t) {
    BodyState* past = memory_.history().At(t, body);
    const float after = static_cast<float>(t - from) * world_.dt();
    if (past != nullptr) *past = PlusScaled(*past, MovedOn(off, after), 1);
  }
  const bool same = off.position.squaredNorm() == 0 && off.velocity.squaredNorm() == 0 &&
                    off.angle == 0 && off.spin == 0 && moved.position == local.position;
  if (same) return;
  const BodyState corrected = WithinLimits(moved, world_.scene().speed_limit);
  const bool moves = corrected.velocity.squaredNorm() > 0 || corrected.spin != 0;
  world_.Write(body, corrected, moves || world_.awake(body));
  if (BodyState* past = memory_.history().At(now, body)) *past = world_.Read(body);
  display_.Moved(body, Minus(corrected, local));
}

}  // namespace seam
