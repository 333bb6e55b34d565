#pragma once
/// Rolls the world back to the tick of a message and steps it again to now.
///
///   barrier      t1 message                      now
///   --|-----------o-----|-----------|-----------|--o     all messages between two steps: one
///     restore --> write ... step, step, step ...         replay, from the oldest t1
///
/// The authority's states are written at every tick for which one is known, so earlier messages
/// still count. Own bodies are stepped again too: a collision that went differently did so for both
/// bodies.
///
/// Inputs act at their own ticks (rollback, and clients of mode central), so both sides of a
/// contact reach the same result from the same inputs; differences of a few quanta are left alone.

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "common/physics/world.h"
#include "common/sync/body_memory.h"
#include "common/sync/display.h"
#include "common/sync/inputs/input_track.h"
#include "common/sync/mode.h"
#include "common/sync/reach/driven.h"
#include "common/sync/roles.h"

namespace seam {

/// Longest replay, s. At 200 ms one way, an input is known elsewhere after 0.4 s, and the state of
/// the tick that it completed another 0.4 s later. Less than the history.
constexpr int kReplayMax = 2;

/// Does nothing at peers that never roll back (Policy::GoesBack).
class Replay {
 public:
  /// All must outlive this. `inputs`: by player.
  Replay(const SyncConfig& config, World& world, const Roles& roles, const Drivers& drivers,
         BodyMemory& memory, Display& display, const std::vector<InputTrack>& inputs);

  /// Requests a replay from `tick`, for which a state of `body` arrived; nothing to do if it agrees
  /// with our past. Returns false if `tick` cannot be reached.
  bool Ask(int body, std::int64_t tick);
  /// Requests a replay from `tick`, or from the oldest tick that can be reached.
  void AskFrom(std::int64_t tick);
  /// The oldest tick that can be reached; now if there is none.
  std::int64_t oldest() const {
    return barriers_.empty() ? world_.tick() : barriers_.front().world->tick;
  }
  /// The newest tick that could be reached when a change of an earlier one was heard of: what
  /// follows lacks that change. -1: never.
  std::int64_t missed() const { return missed_; }
  /// All ticks before this one are final as far as is known: a pending replay begins here. The
  /// world's tick if none is pending.
  std::int64_t settled() const { return from_ < 0 ? world_.tick() : from_; }

  /// Rolls back to the oldest requested tick and steps again to now. If the budget is used up,
  /// leaves the replay to the next call.
  void Run();
  /// Calls `call` after each tick of a replay, with the world as just stepped.
  void OnReplayedTick(std::function<void()> call) { on_stepped_again_ = std::move(call); }
  /// Call after a step. Makes each BarrierEvery-th tick a barrier, needed or not, because worlds
  /// that are to agree bit for bit must be rebuilt at the same ticks. A world that need not agree
  /// with another peer's is only copied, and less often.
  void TakeBarrier();
  /// Drops all barriers: a body is new, or the bodies have changed.
  void Forget();
  /// Makes this tick a barrier, also for replays, and returns it.
  std::shared_ptr<const WorldSnapshot> BarrierNow();
  /// Returns the newest barrier of these ticks from which another peer can go on; nullptr: none.
  std::shared_ptr<const WorldSnapshot> SharedBarrier(std::int64_t from, std::int64_t to) const;
  /// Goes on from another peer's barrier: the next Run steps again from there. Returns false if it
  /// cannot be reached. Requires World::Load of it, and a recorded past of its tick.
  bool GoOnFrom(std::shared_ptr<const WorldSnapshot> barrier);
  // Saved rooms (replay_saved.cpp): PersistBarriers, then Persist.
  /// Saves the barriers of tick `from` or later before this tick's, or loads them. Reading leaves
  /// the world in any state: load it afterwards.
  void PersistBarriers(StateArchive& a, std::int64_t from);
  /// Saves or loads all else. `now`: the barrier of this tick.
  void Persist(StateArchive& a, std::shared_ptr<const WorldSnapshot> now);

  // Edits at their tick (replay_edits.cpp). For each, in their order: GoBackTo, World::Apply,
  // BodyTable::Renumber if the bodies have changed, Edited; after the last one GoOn.
  /// Rolls back to the state after `tick`, or as near to it as can be reached; never before an edit
  /// that changed bodies. The world stays at that tick until GoOn.
  void GoBackTo(std::int64_t tick);
  /// Records an edit. `changed`: bodies were recreated, and ticks before this edit can no longer be
  /// reached. Replays repeat the other edits at their ticks.
  void Edited(const Edit& edit, bool changed);
  /// True if a peer that has applied only the first `revision` edits lacks one that took effect
  /// before `tick`: its states of that tick belong to a world without that edit.
  bool LacksEdit(int revision, std::int64_t tick) const;
  /// Tick of the last edit that changed bodies; -1: none.
  std::int64_t edited_tick() const { return edited_tick_; }
  /// Steps again to now.
  void GoOn();
  /// The tick at which GoOn will end; the world's tick outside a replay.
  std::int64_t now() const { return journey_ ? journey_->now : world_.tick(); }

  /// True if a difference is too small to correct.
  static bool Agrees(const BodyState& difference);
  std::int64_t ticks_stepped_again() const { return stepped_again_; }
  /// Number of Run calls that left their replay to the next call.
  std::int64_t deferred() const { return deferred_; }

 private:
  struct Barrier {
    std::shared_ptr<const WorldSnapshot> world;  // another thread may write it to a file
    std::int64_t edits = 0;  ///< number of edits before it that changed no bodies
    bool rebuilt = true;     ///< the world was rebuilt from it, and not only copied
  };
  /// An edit that changed no bodies.
  struct Repeated {
    Edit edit;
    std::int64_t tick = 0;
    int sat = -1;  ///< if a SeatEdit: the seat's player before
  };

  bool KeepsRest(int body, const BodyState& pose);
  bool RestsAsCopy(int body) const;
  /// A body as displayed before it is stepped again.
  struct Shown {
    int body = -1;
    BodyState state;
    bool awake = true;
  };
  struct Journey {
    std::int64_t now = 0;
    std::vector<Shown> shown;  // ascending by body; of GoBackTo: all bodies of that moment
  };

  /// True if an edit that changed bodies lies between `tick` and now. Extrapolated without that
  /// edit, the state says nothing about now, and newer ones are on their way.
  bool IsBeforeEdit(std::int64_t tick) const;
  /// True if the state that was heard of the tick is another than the body had here.
  bool HeardOtherwise(int body, std::int64_t tick) const;
  bool Depart(std::int64_t from, bool all);
  void RestoreDormant();
  void StepTo(std::int64_t tick);
  void Arrive();
  void BarrierAfterEdits();
  void AddBarrier(bool alone);
  /// True if no other peer simulates or drives any body that this peer simulates.
  bool IsAlone() const;
  void DropBarriers();
  static void PersistAll(StateArchive& a, std::vector<Barrier>* barriers);
  void PersistEdits(StateArchive& a);
  void RecordSeats();
  void ForgetHeard();
  void UndoEdits();
  void RepeatEdits();
  /// Carries the displayed states over to the bodies after an edit.
  void CarryShown(const BodyRemap& change);
  bool SimulateFrom(int body, std::int64_t tick);
  bool FollowsHistory(int body, std::int64_t tick) const;
  bool IsFact(int body, std::int64_t tick) const;
  void WriteKnownStates();
  void WriteKnownStates(int body);
  void ReplayTick();
  void ActAgain(std::int64_t next);

  const SyncConfig& config_;
  World& world_;
  const Roles& roles_;
  const Drivers& drivers_;
  BodyMemory& memory_;
  Display& display_;
  const std::vector<InputTrack>& inputs_;
  std::deque<Barrier> barriers_;                      // ascending
  std::deque<Repeated> edits_;                        // since the first barrier; ticks ascend
  std::int64_t edits_before_ = 0;                     // number of edits dropped from the front of
                                                      // edits_
  std::int64_t edits_done_ = 0;                       // number of edits that the world has had
  std::deque<std::pair<int, std::int64_t>> applied_;  // revisions and ticks; both ascend
  std::vector<int> sitters_;                          // by seat, as of the last edit
  std::int64_t from_ = -1;                            // oldest requested tick; -1: none
  std::int64_t missed_ = -1;                          // see missed()
  bool was_alone_ = false;                            // at the previous send tick
  double credit_ = 0;                                 // ticks that may still be stepped again
  std::function<void()> on_stepped_again_ = [] {};
  std::optional<Journey> journey_;  // set while the world is in the past
  std::int64_t edited_tick_ = -1;   // last edit that changed bodies; -1: none
  bool edited_ = false;             // bodies were recreated since the last step
  std::int64_t stepped_again_ = 0;
  std::int64_t deferred_ = 0;
  EditHook carry_shown_{memory_.table(), [this](const BodyRemap& c) { CarryShown(c); }};
};

}  // namespace seam
