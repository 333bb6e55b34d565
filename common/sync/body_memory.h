#pragma once
/// What a peer remembers of the bodies of its world: where they were, what it heard of them, and
/// what happened to them. A remap carries all of it at once.

#include <cstdint>
#include <utility>
#include <vector>

#include "common/physics/history.h"
#include "common/physics/world.h"
#include "common/sync/authority.h"
#include "common/sync/mode.h"
#include "common/sync/reconcile/reconcile.h"
#include "common/sync/snapshots.h"

namespace seam {

/// Stands for the tick of what never happened: so long ago that it no longer counts.
constexpr std::int64_t kLongAgo = -1000000;

/// What rules that act in every tick go by between two messages.
struct PullTrack {
  std::int64_t arrived = -1;  ///< tick of the newest message's arrival, -1 none
  BodyState arrival;          ///< our copy then
  BodyState target_then;      ///< where the authority's was thought to be then
  PullMemory memory;
};

/// What is remembered of one body besides its past and what was heard of it.
struct BodyTrack {
  std::int64_t last_impact_tick = kLongAgo;  ///< of a major impact
  std::int64_t heard_tick = -1;              ///< tick of the newest state received, -1 never
  std::int32_t heard_epoch = 0;              ///< and its epoch
  std::int64_t dynamic_since = 0;  ///< from this tick on its past is comparable with another's:
                                   ///< it was simulated here and was this same body
  bool placed = true;              ///< its pose is known
  float priority = 0;              ///< grows until it is sent
  std::int64_t asleep_since = -1;  ///< tick, as far as sending noticed; -1 awake
  std::int64_t told_tick = -1;     ///< newest that this peer has told of as its authority, and
                                   ///< that no input still to come can change
  int changed_at = 0;              ///< edits there were when it was last changed
  PullTrack pull;
  bool at_rest = false;  ///< its authority has committed it to rest, and it lies there (RestCommit)
  bool idle = false;     ///< own, at rest, and absent because nothing could touch it (Presence)
};

/// What is remembered of one mechanism.
struct MechanismTrack {
  std::int64_t last_coupled_tick = kLongAgo;  ///< it touched one of another authority
};

class BodyMemory {
 public:
  /// Where everything is at tick 0 and how it moves is known from the scene: it counts as heard.
  /// The world must outlive this.
  BodyMemory(const SyncConfig& config, const World& world);

  BodyTrack& track(int body) { return bodies_[static_cast<std::size_t>(body)]; }
  const BodyTrack& track(int body) const { return bodies_[static_cast<std::size_t>(body)]; }
  History& history() { return history_; }
  const History& history() const { return history_; }
  Snapshots& snapshots() { return snapshots_; }
  const Snapshots& snapshots() const { return snapshots_; }

  /// Our copy at a tick, if it is comparable with the authority's; else nullptr.
  const BodyState* ComparablePast(int body, std::int64_t tick) const;
  /// Whether the mechanism touches, or touched a moment ago, one of another authority.
  bool Coupled(int mechanism) const;
  /// Whether the body had a major impact within the last second.
  bool Struck(int body) const;

  /// Whether gravity alone moved it to this state at `tick`, or threw it back from what it touched:
  /// the tick of a bounce is the first of a flight. Of what has joints nobody asks: never.
  bool FallsFreely(int body, std::int64_t tick, const BodyState& state) const;
  /// The newest that was heard of it, moved on to `tick`, by kReckonMax at most. Requires that
  /// something was.
  BodyState MovedOn(int body, std::int64_t tick) const;

  /// After a step: major impacts, and what touches across authorities.
  void NoteContacts(const AuthorityTable& table);
  /// At the end of a tick: all poses become past.
  void Record();

  // What a peer only displays and nobody looks at lies parked: absent, asleep, in one pose. No tick
  // looks at it, and its past is that pose.
  /// Bodies that are not parked, ascending.
  const std::vector<int>& tended() const { return tended_; }
  bool parked(int body) const { return parked_[static_cast<std::size_t>(body)].since >= 0; }
  /// From the next tick on the body lies where the world has it. Requires that it is absent there.
  void Park(int body);
  /// Before it is written to, or is to be present; nothing if it is not parked.
  void Unpark(int body);
  void UnparkAll();
  /// It was written to all the same: it lies parked there, as if it always had. Nothing if it is
  /// not parked.
  void MoveParked(int body) {
    if (parked(body)) parked_[static_cast<std::size_t>(body)].pose = world_.Read(body);
  }
  /// Something new was heard of the body, or it was moved along its path: only then an absent one
  /// has to be looked at.
  void NoteNews(int body) { news_.push_back(body); }
  /// Since ForgetNews, in any order, some twice.
  const std::vector<int>& news() const { return news_; }
  void ForgetNews() { news_.clear(); }

  /// The world was set to another tick: no pose is known any more.
  void StartAnew();
  /// The world's bodies have changed; what is known is carried over to what they became.
  void Remap(const BodyRemap& change);

 private:
  const SyncConfig& config_;
  const World& world_;
  History history_;
  Snapshots snapshots_;
  std::vector<BodyTrack> bodies_;
  std::vector<MechanismTrack> mechanisms_;
  struct Parked {
    std::int64_t since = -1;  // tick up to which its past is noted; -1: it is not parked
    BodyState pose;
  };
  void Tend();
  void FillPast(int body);
  /// Its pose is to be recorded at every tick until it has lain still for long.
  void Open(int body) {
    if (std::exchange(noted_[static_cast<std::size_t>(body)].open, true)) return;
    open_.push_back(body);
  }
  void OpenChanged();
  struct Noted {
    std::uint64_t still = 0;  // World::still when it was last recorded
    int ticks = 0;            // recorded in a row with that
    bool open = false;        // it is in open_
  };
  std::vector<Noted> noted_;    // by body
  std::vector<int> open_;       // bodies that Record looks at: all that are tended but for those
                                // that have lain still for as long as the past is noted
  std::uint64_t change_ = 0;    // World::last_change when it was found last what is open
  std::vector<int> changed_;    // for OpenChanged
  std::vector<Parked> parked_;  // by body
  std::vector<int> tended_, news_;
};

/// A change of velocity that counts as a major impact, m/s. A driven wheel feels up to 2.6 m/s from
/// the ground in every tick: a lower limit counts it as colliding all the time; a higher one lets
/// old states overrule real collisions.
constexpr float kMajorImpact = 3.0f;

}  // namespace seam
