#pragma once
/// The one place that corrects the bodies that are simulated here by what was heard of them.
/// Besides it only physics moves them, a replay (which it asks for), and RestCommit, which puts
/// bodies at rest where they lie at their authority.
///
///   States --> corrector_receive   which are new, and of whom
///                corrector_correct   the room's rule: what to add to a secondary's copy now
///                corrector_pull      ...and before every step, by rules that ask for it
///   ExactStates --> corrector_take_over  copies of what changes hands are put right
///   roles  --> corrector_roles     a body simulated from now on begins at the authority's state

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "common/codec/messages.h"
#include "common/physics/world.h"
#include "common/sync/body_memory.h"
#include "common/sync/correct/replay.h"
#include "common/sync/display.h"
#include "common/sync/mode.h"
#include "common/sync/reach/presence.h"
#include "common/sync/roles.h"

namespace seam {

/// What became of the bodies of a States message.
struct Received {
  int used = 0;
  int stale = 0;    ///< older than what is known, or of an old epoch
  int unknown = 0;  ///< no such body, or this peer's own
};

class Corrector {
 public:
  /// All must outlive this.
  Corrector(const SyncConfig& config, World& world, const Roles& roles, const Presence& presence,
            BodyMemory& memory, Display& display, Replay& replay);

  /// States of another peer's bodies. Those of ticks or edits still to come wait for them.
  Received Receive(const States& states);
  /// After a step: what waited is received again.
  void ReceiveWaiting();
  /// Takes poses as they are, of bodies whose pose is not known yet.
  void Place(const States& states);
  /// After the last of them: what has been moved on to now body by body is closed, and whole turns
  /// are as hinges allow them.
  void ClosePlaced();
  /// Where bodies were when their holder let go: copies are put right at once, so that who takes
  /// over begins from there. The largest difference there was; zero of what is only displayed.
  BodyState TakeOver(const ExactStates& exact);
  /// Before a step: pulls copies on, if the room's rule acts in every tick.
  void PullCopies();
  /// After a change of roles: bodies become dynamic, led, absent or kinematic. Whether one that
  /// moves begins to be simulated.
  bool FollowRoles();
  /// The same of these bodies alone, ascending. After a change of who is near: of what is tended.
  bool FollowRoles(const std::vector<int>& bodies);
  /// Messages of ticks or edits still to come.
  std::size_t waiting() const { return waiting_.size(); }

 private:
  /// An entry of a States message, and the body that it is of.
  using Entry = std::pair<std::size_t, int>;

  /// Whether an entry is news; counts it.
  bool IsEarly(const States& states) const;
  /// Whether it is of a tick that is not far from now.
  bool IsNear(const States& states) const;
  void Wait(const States& states);
  bool IsNews(const States& states, std::size_t i, int body, Received* result) const;
  /// Notes one entry; true if its body is simulated here and to be corrected.
  bool ReceiveOne(const States& states, std::size_t i, int body);
  void PutExact(int body, std::int64_t from, const BodyState& difference, const BodyState& told,
                std::int64_t told_tick);
  void BringBack(int body, const BodyState& told, std::int64_t tick);
  void PlaceNow(int body, std::int64_t tick, const BodyState& remote, bool asleep);
  void PlaceBody(int body, const BodyState& state, bool asleep);
  /// Mass-weighted mean of Xr(t1) - Xl(t1) by mechanism.
  std::map<int, BodyState> CommonDifferences(const States& states,
                                             const std::vector<Entry>& entries) const;
  /// Our comparable past at `tick`, with the velocity of the near tick at which our copy moved most
  /// like `remote`. Requires that there is one.
  BodyState LikePast(int body, std::int64_t tick, const BodyState& remote) const;
  /// Where a copy may be put that is to go to `target`, when its authority had it at `heard` at
  /// tick `from`: nothing anchored lies between there and where it was.
  Vec2 WayTo(int body, const Vec2& heard, std::int64_t from, const Vec2& target) const;
  bool CameFrom(int body, const Vec2& heard, std::int64_t from) const;
  void Correct(int body, const States& states, std::size_t i, const BodyState& common);
  void TakeRest(int body, const BodyState& local, const BodyState& remote);
  void Blend(int body, const BodyState& local, const Correction& c, std::int64_t from);
  Motion WantedMotion(int body) const;
  bool BeginToSimulate(int body);
  bool WasStruckHereAlone(int body) const;
  void CloseBegun(int mechanism);
  template <class Put>
  void Close(int mechanism, bool only_turns, const Put& put);
  BodyState PullTarget(int body, std::int64_t at) const;
  void NoteArrival(int body);

  const SyncConfig& config_;
  World& world_;
  const Roles& roles_;
  const Presence& presence_;
  BodyMemory& memory_;
  Display& display_;
  Replay& replay_;
  std::vector<States> waiting_;  // of ticks or edits still to come
  std::vector<States> waited_;   // that waited: their memory is used again
  /// Ids of bodies that have been placed, and whether they were moved on to now: not closed yet.
  std::vector<std::pair<int, bool>> placed_;
  std::vector<BodyState> poses_;  // by body: of the mechanism that is being closed
};

}  // namespace seam
