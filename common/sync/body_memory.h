#pragma once
/// A peer's record of each body in its world: past poses, states received, and recent events. A
/// remap carries all of it over.

#include <cstdint>
#include <utility>
#include <vector>

#include "common/physics/world.h"
#include "common/sync/authority.h"
#include "common/sync/history.h"
#include "common/sync/mode.h"
#include "common/sync/snapshots.h"
#include "common/sync/state_arithmetic.h"
#include "common/sync/table/body_column.h"
#include "common/sync/table/mechanism_column.h"

namespace seam {

/// Tick of an event that never happened: so long ago that it no longer counts.
constexpr std::int64_t kLongAgo = -1000000;
/// Length of the history, s. An older state is corrected without a comparable past.
constexpr int kHistory = 3;

/// State of a puller between two messages.
struct PullTrack {
  std::int64_t arrived = -1;  ///< tick at which the newest message arrived; -1: none
  PullMemory memory;
};

/// Record of one body, besides its past and the states received.
struct BodyTrack {
  std::int64_t last_impact_tick = kLongAgo;  ///< tick of the last major impact
  std::int64_t heard_tick = -1;              ///< tick of the newest state received; -1: never
  std::int32_t heard_epoch = 0;              ///< epoch of that state
  std::int64_t dynamic_since = 0;  ///< from this tick on its past is comparable with another
                                   ///< peer's: it was simulated here, as this same body
  bool placed = true;              ///< its pose is known
  float priority = 0;              ///< grows until the body is sent
  std::int64_t asleep_since = -1;  ///< first tick at which a send found it asleep; -1: awake
  std::int64_t sent_tick = kLongAgo;  ///< world's tick when its state was last sent
  std::int32_t sent_epoch = -1;       ///< epoch of that state
  std::int64_t told_tick = -1;     ///< newest tick for which this peer sent its state as authority
                                   ///< and no future input can change it
  int changed_at = 0;              ///< number of edits when it last changed
  PullTrack pull;
  bool at_rest = false;  ///< held at the pose that its authority committed (RestCommit)
};

/// Record of one mechanism.
struct MechanismTrack {
  std::int64_t last_coupled_tick = kLongAgo;  ///< last tick at which it touched one of another
                                              ///< authority
  std::int64_t unsettled_until = kLongAgo;    ///< tick up to which every send has its states
  std::int64_t differed_tick = kLongAgo;      ///< tick of the last report that it differs
};

class BodyMemory {
 public:
  /// Starts with the scene's state at tick 0, which counts as heard. The world and the table of its
  /// bodies must outlive this.
  BodyMemory(const SyncConfig& config, const World& world, const BodyTable& table);

  /// The table that the columns of this peer's bodies register with.
  const BodyTable& table() const { return table_; }
  BodyTrack& track(int body) { return bodies_[body]; }
  const BodyTrack& track(int body) const { return bodies_[body]; }
  History& history() { return history_; }
  const History& history() const { return history_; }
  Snapshots& snapshots() { return snapshots_; }
  const Snapshots& snapshots() const { return snapshots_; }

  /// Returns our copy at a tick if it is comparable with the authority's; else nullptr.
  const BodyState* ComparablePast(int body, std::int64_t tick) const;
  /// True if the mechanism touches one of another authority, or did a moment ago.
  bool Coupled(int mechanism) const;
  /// True if a grant, an edit or a report has changed the mechanism within kSettleS.
  bool Unsettled(int mechanism) const {
    return world_.tick() < mechanisms_[mechanism].unsettled_until;
  }
  void NoteUnsettled(int mechanism) {
    mechanisms_[mechanism].unsettled_until = world_.tick() + kSettleS * config_.tick_hz;
  }
  void NoteAllUnsettled() {
    for (int m = 0; m < mechanisms_.size(); ++m) NoteUnsettled(m);
  }
  /// Reports that a received state differs from this peer's copy, at most kRefreshHz times a
  /// second.
  void NoteDiffering(int mechanism);
  /// Returns the ids of the mechanisms reported since the last call.
  std::vector<std::int32_t> TakeDiffering() { return std::exchange(differing_, {}); }
  /// True if the body had a major impact within the last second.
  bool Struck(int body) const;

  /// True if only gravity moved the body to this state at `tick`, or a bounce threw it: the tick of
  /// the bounce is the first of a flight. Always false for jointed bodies.
  bool FallsFreely(int body, std::int64_t tick, const BodyState& state) const;
  /// Returns the newest state heard, extrapolated to `tick`, by at most kReckonMax. Requires such a
  /// state.
  BodyState MovedOn(int body, std::int64_t tick) const;

  /// Call after a step. Records major impacts and contacts between authorities.
  void RecordContacts(const AuthorityTable& table);
  /// Call at the end of a tick. Records all poses as past.
  void Record();

  /// Bodies that are not parked (Activity::kParked), ascending: per-tick loops skip the others.
  const std::vector<int>& unparked() const { return unparked_; }
  bool parked(int body) const { return world_.activity(body) == Activity::kParked; }
  /// Only for Activities, which parks and unparks bodies; requires that it is parked. From the next
  /// tick until Unpark, which records it, the body's past is the pose that it then has.
  void Park(int body);
  void Unpark(int body);
  void UnparkAll();
  /// Marks that the body was heard of or moved along its path: only then does a body that is not
  /// present need checking.
  void MarkUpdated(int body) { news_.push_back(body); }
  /// Bodies marked since ClearUpdated, in any order, some twice.
  const std::vector<int>& news() const { return news_; }
  void ClearUpdated() { news_.clear(); }

  /// Forgets all poses. Call when the world was set to another tick.
  void StartAnew();
  /// Requires that no body is parked. Reading: call when the world is at its tick. The past and the
  /// states heard begin with the world's poses, until PersistPast.
  void Persist(StateArchive& a);
  /// Saves the past and the states heard from tick `from` on, or loads them. `still`: see Still.
  void PersistPast(StateArchive& a, std::int64_t from, const std::vector<char>& still);
  /// Returns 1 for each body that has had one pose in the whole recorded past, as far as is known
  /// without a look at it; by body.
  std::vector<char> Still() const;

 private:
  struct Noted {
    std::uint64_t still = 0;  // World::still at the last recording
    int ticks = 0;            // consecutive recordings with that value
    bool open = false;        // the body is in open_
  };
  BodyTrack AfterEdit(const BodyOrigin& origin, const BodyTrack* before) const;
  void Edited(const BodyRemap& change);
  void Restart();
  void FillPast(int body);
  /// Records the body's pose at every tick from now on, until it has lain still for long.
  void Open(int body) {
    if (std::exchange(noted_[body].open, true)) return;
    open_.push_back(body);
  }
  void OpenChanged();

  const SyncConfig& config_;
  const World& world_;
  const BodyTable& table_;
  History history_;
  Snapshots snapshots_;
  BodyColumn<BodyTrack> bodies_;
  MechanismColumn<MechanismTrack> mechanisms_;
  std::vector<std::int32_t> differing_;  // ids for TakeDiffering
  BodyColumn<Noted> noted_;
  std::vector<int> open_;     // bodies that Record checks: all unparked ones but those that have
                              // lain still for the whole recorded past
  std::uint64_t change_ = 0;  // World::last_change at the last OpenChanged
  std::vector<int> changed_;  // for OpenChanged
  BodyColumn<std::int64_t> parked_since_;  // tick up to which the past of a parked one is recorded
  std::vector<int> unparked_, news_;
  EditHook edited_;
};

/// A change of velocity that counts as a major impact, m/s. A driven wheel feels up to 2.6 m/s from
/// the ground in every tick: a lower limit would see constant collisions; a higher one would let
/// old states overrule real collisions.
constexpr float kMajorImpact = 3.0f;

}  // namespace seam
