/// Corrector: changes of role. A body that becomes simulated starts from the authority's state; a
/// body that becomes displayed continues from its current state.

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "common/base/geometry.h"
#include "common/sync/correct/corrector.h"
#include "common/sync/reach/way_to.h"
#include "common/sync/state_limits.h"

namespace seam {
namespace {

/// A state counts as recent if it was heard at most a second / kHeardLatelyPart ago.
constexpr int kHeardLatelyPart = 5;

}  // namespace

bool Corrector::FollowRoles() {
  std::vector<int> all(static_cast<std::size_t>(world_.body_count()));
  std::iota(all.begin(), all.end(), 0);
  return FollowRoles(all);
}

bool Corrector::FollowRoles(const std::vector<int>& bodies) {
  const std::int64_t now = world_.tick();
  bool moves = false;
  std::vector<int> begun;  // mechanisms that begin to be simulated from where they are by now
  for (const int body : bodies) {
    const Activity was = world_.activity(body), wanted = activities_.Wanted(body);
    if (was == wanted) continue;
    // A body simulated until now is extrapolated from its current state. The last state heard may
    // be from before this peer had the authority.
    if (was == Activity::kSimulated && !HadUnreportedImpact(body)) {
      const BodyState state = world_.Read(body);
      memory_.snapshots().Add(body, now, state, memory_.FallsFreely(body, now, state));
    }
    const bool asleep = !world_.awake(body);
    activities_.Update(body);
    if (was == Activity::kDormant) continue;  // it has been this peer's own all along
    if (wanted == Activity::kSimulated) {
      moves = moves || !asleep;
      const bool begins = memory_.snapshots().has(body) && !BeginToSimulate(body);
      if (begins) begun.push_back(world_.mechanism(body));
    }
    if (was == Activity::kParked) display_.Reset(body);  // it was out of sight
  }
  std::sort(begun.begin(), begun.end());
  begun.erase(std::unique(begun.begin(), begun.end()), begun.end());
  for (const int mechanism : begun) CloseBegun(mechanism);
  return moves;
}

/// Returns true if a copy moves after an impact that its holder, heard a moment ago, does not
/// report. The display would continue that motion until the next state, and states of displayed
/// bodies are rare.
bool Corrector::HadUnreportedImpact(int body) const {
  const std::int64_t now = world_.tick();
  const Snapshots& heard = memory_.snapshots();
  const std::int64_t lately = now - config_.tick_hz / kHeardLatelyPart;
  if (!heard.has(body) || heard.newest_tick(body) < lately) return false;
  const Vec2 off = world_.Read(body).velocity - memory_.MovedOn(body, now).velocity;
  return off.norm() > kMajorImpact;
}

/// Closes a mechanism whose bodies were extrapolated one by one, which tears its joints; the engine
/// would close them violently.
void Corrector::CloseBegun(int mechanism) {
  Close(mechanism, false, [&](int body, const BodyState& closed) {
    if (world_.activity(body) != Activity::kSimulated) return;
    display_.Moved(body, Minus(closed, world_.Read(body)));
    world_.Write(body, closed);
  });
}

/// Closes mechanisms without a visual offset: they have not been displayed yet.
void Corrector::ClosePlaced() {
  std::map<int, bool> mechanisms;  // true if any of its bodies was extrapolated
  for (const auto& [id, moved_on] : placed_) {
    const int body = world_.BodyOfId(id);
    if (body < 0) continue;
    bool& any = mechanisms[world_.mechanism(body)];
    any = any || moved_on;
  }
  placed_.clear();
  for (const auto& [mechanism, moved_on] : mechanisms) {
    const std::vector<int>& bodies = display_.joints().bodies(mechanism);
    const bool whole = std::all_of(bodies.begin(), bodies.end(),
                                   [&](int body) { return memory_.track(body).placed; });
    if (!whole) continue;
    Close(mechanism, !moved_on, [&](int body, const BodyState& closed) {
      const bool awake = world_.awake(body);
      world_.Write(body, closed);
      if (!awake) world_.SetAwake(body, false);
    });
  }
}

/// Calls `put` with each body of a mechanism that closing moves, and its new pose.
template <class Put>
void Corrector::Close(int mechanism, bool only_turns, const Put& put) {
  const JointCloser& joints = display_.joints();
  if (!joints.jointed(mechanism)) return;
  poses_.resize(static_cast<std::size_t>(world_.body_count()));
  for (const int body : joints.bodies(mechanism)) {
    poses_[static_cast<std::size_t>(body)] = world_.Read(body);
  }
  joints.Unwind(mechanism, &poses_);
  if (!only_turns) {
    // Springs start as they were heard: a wheel heard during a crash would otherwise travel along
    // its spring for the whole extrapolation, and the engine would pull it back violently.
    std::vector<BodyState> heard = poses_;
    for (const int body : joints.bodies(mechanism)) {
      if (!memory_.snapshots().has(body)) continue;
      heard[static_cast<std::size_t>(body)] = memory_.snapshots().newest(body);
    }
    joints.Unwind(mechanism, &heard);
    joints.CloseMovedOn(mechanism, heard, &poses_);
  }
  for (const int body : joints.bodies(mechanism)) {
    const BodyState& closed = poses_[static_cast<std::size_t>(body)];
    if (Negligible(Minus(closed, world_.Read(body)))) continue;
    put(body, closed);
    if (BodyState* past = memory_.history().At(world_.tick(), body)) *past = world_.Read(body);
  }
}

/// Starts simulating a body. Its velocity was that of the display, so it takes the authority's
/// state: the exact state heard if a replay can reach it. A body committed to rest has stayed at
/// rest since, however old the commitment. Returns true if a replay was requested.
bool Corrector::BeginToSimulate(int body) {
  const std::int64_t now = world_.tick();
  const BodyState before = world_.Read(body);
  BodyState state = memory_.MovedOn(body, now);
  state.angle = UnwrapAngle(state.angle, before.angle);
  const Vec2 told = memory_.snapshots().newest(body).position;
  const std::int64_t told_tick = memory_.snapshots().newest_tick(body);
  // The display moves bodies through walls: its path proves nothing.
  memory_.track(body).dynamic_since = now;
  if (!memory_.snapshots().falls(body)) {  // a falling one bounces off anchored shapes already
    state.position = WayTo(world_, memory_, body, told, told_tick, state.position);
  }
  world_.Write(body, state);
  display_.Moved(body, Minus(state, before));
  if (BodyState* past = memory_.history().At(now, body)) *past = state;
  const std::int64_t heard = memory_.snapshots().newest_tick(body);
  return heard < now && !memory_.track(body).at_rest && replay_.Ask(body, heard);
}

}  // namespace seam
