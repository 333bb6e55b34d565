#pragma once
/// Corrects the simulated copies of other peers' bodies by the states received. Apart from physics
/// only three classes also move such bodies: Replay and Blender, at the request of Corrector, and
/// RestCommit, which puts resting bodies at their committed poses.
///
///   States --> corrector_receive   filters new states, by body; goes back for them (Replay) or
///                                  corrects copies by the room's rule (Blender)
///   ExactStates --> corrector_take_over  corrects copies of mechanisms that change hands
///   roles  --> corrector_roles     starts newly simulated bodies at the authority's state

#include <cstdint>
#include <utility>
#include <vector>

#include "common/codec/messages.h"
#include "common/physics/world.h"
#include "common/sync/blend/blender.h"
#include "common/sync/body_memory.h"
#include "common/sync/display.h"
#include "common/sync/mode.h"
#include "common/sync/reach/activities.h"
#include "common/sync/roles.h"
#include "common/sync/rollback/replay.h"

namespace seam {

/// Result of a States message: number of bodies per outcome.
struct Received {
  int used = 0;
  int stale = 0;    ///< older than a known state, or of an old epoch
  int unknown = 0;  ///< no such body, or this peer's own
};

class Corrector {
 public:
  /// All must outlive this.
  Corrector(const SyncConfig& config, World& world, const Roles& roles, Activities& activities,
            BodyMemory& memory, Display& display, Replay& replay);

  /// Takes states of another peer's bodies. States of future ticks or edits are kept until then.
  Received Receive(const States& states);
  /// Call after a step. Receives the kept states that are now due.
  void ReceiveWaiting();
  /// Places bodies that have no known pose yet. Other bodies are not changed.
  void Place(const States& states);
  /// Call after the last Place. Closes joints that opened because bodies were extrapolated one by
  /// one, and takes off whole turns that hinges do not allow.
  void ClosePlaced();
  /// Takes over the exact states at which a holder let go. Copies are corrected at once, so that
  /// the next holder starts from there. Returns the largest difference; zero for bodies that are
  /// only displayed.
  BodyState TakeOver(const ExactStates& exact);
  /// Call before a step; see Blender::Pull.
  void PullCopies() { blender_.Pull(); }
  /// Call after a change of roles. Updates all activities. Returns true if an awake body became
  /// simulated.
  bool FollowRoles();
  /// Like the above for these bodies only, ascending. Call after a check of Activities.
  bool FollowRoles(const std::vector<int>& bodies);
  /// Saves or loads the kept states.
  void Persist(StateArchive& a);
  /// Number of messages kept for a future tick or edit.
  std::size_t waiting() const { return waiting_.size(); }

 private:
  /// True if the message is of a future tick or revision.
  bool IsEarly(const States& states) const;
  /// True if its tick is not far from now.
  bool IsNear(const States& states) const;
  void Wait(const States& states);
  /// True if an entry is newer than the known state of its body; counts the outcome in `result`.
  bool IsNews(const States& states, std::size_t i, int body, Received* result) const;
  /// Records one entry. Returns true if its body is simulated here and to be corrected.
  bool ReceiveOne(const States& states, std::size_t i, int body);
  void ApplyDifference(int body, std::int64_t from, const BodyState& difference,
                       const BodyState& told, std::int64_t told_tick);
  void BringBack(int body, const BodyState& told, std::int64_t tick);
  void PlaceNow(int body, std::int64_t tick, const BodyState& remote, bool asleep);
  void PlaceBody(int body, const BodyState& state, bool asleep);
  bool BeginToSimulate(int body);
  bool HadUnreportedImpact(int body) const;
  void CloseBegun(int mechanism);
  template <class Put>
  void Close(int mechanism, bool only_turns, const Put& put);

  const SyncConfig& config_;
  World& world_;
  const Roles& roles_;
  Activities& activities_;
  BodyMemory& memory_;
  Display& display_;
  Replay& replay_;
  Blender blender_;
  std::vector<States> waiting_;  // for future ticks or edits
  std::vector<States> waited_;   // former entries of waiting_; their memory is reused
  /// Bodies that were placed but not yet closed: id, and true if extrapolated to now.
  std::vector<std::pair<int, bool>> placed_;
  std::vector<BodyState> poses_;  // scratch, by body: poses of the mechanism being closed
};

}  // namespace seam
