#pragma once
/// Going back to where a message is from, and stepping again from there.
///
///   barrier      t1 message                      now
///   --|-----------o-----|-----------|-----------|--o     all that came between two steps: one
///     restore --> put in ... step, step, step ...        replay, from the oldest t1
///
/// The authority's states are put in at every tick of which one is known, so what was heard before
/// is not forgotten. Our own bodies are stepped again, too: a collision that was otherwise than we
/// thought was so for both.
///
/// Where rules that only look at states (resimulate) have bodies of several authorities press
/// against each other without a blow, ours follow their history and the others' are corrected by a
/// share: there each peer would correct towards what the other corrected. Rules that stamp inputs
/// (rollback, and clients of mode central) need none of this: both sides come to the same with the
/// same inputs, and what agrees within a few quanta is left alone.

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "common/physics/world.h"
#include "common/sync/body_memory.h"
#include "common/sync/display.h"
#include "common/sync/input_track.h"
#include "common/sync/mode.h"
#include "common/sync/reach/driven.h"
#include "common/sync/roles.h"

namespace seam {

/// Does nothing at peers that do not go back (SyncConfig::GoesBack).
class Replay {
 public:
  /// All must outlive this. `inputs`: by player.
  Replay(const SyncConfig& config, World& world, const Roles& roles, const Drivers& drivers,
         BodyMemory& memory, Display& display, const std::vector<InputTrack>& inputs);

  /// Asks for a replay from `tick`, of which a state of `body` came; none is needed if it agrees
  /// with our past. False: there is no way back to that tick.
  bool Ask(int body, std::int64_t tick);
  /// Asks for a replay from `tick`, or from the oldest to which there is a way.
  void AskFrom(std::int64_t tick);
  /// The oldest tick to which there is a way; now, if there is none.
  std::int64_t oldest() const {
    return barriers_.empty() ? world_.tick() : barriers_.front().world.tick;
  }
  /// All before this tick is as it will stay, as far as is known: a replay that waits begins here.
  /// The world's tick if none waits.
  std::int64_t settled() const { return from_ < 0 ? world_.tick() : from_; }

  /// Goes back to the oldest tick asked for and steps again to now; or, when the budget is used up,
  /// leaves it for the next call.
  void Run();
  /// Called after each tick that is stepped again, with the world as it was stepped.
  void OnSteppedAgain(std::function<void()> call) { on_stepped_again_ = std::move(call); }
  /// After a step to a tick of which States are sent: makes it one to go back to. At every such
  /// tick, needed or not: worlds that are to come to the same bits are built anew at the same
  /// ticks. A world that has to agree with nobody's is kept as it is, and less often.
  void TakeBarrier();
  /// This peer did a player's action (index) before the step to `tick`; a replay repeats it. Not
  /// for rules that stamp inputs.
  void NoteAction(std::int64_t tick, int player, int action);
  /// There is no way back to before now: a body is new, or the bodies have changed.
  void Forget();

  // Edits at their tick (replay_edits.cpp). For each, in their order: GoBackTo, World::Apply, Remap
  // if the bodies have changed, Edited; after the last one GoOn.
  /// Goes to where the world was after `tick`, or as near to it as there is a way: never before an
  /// edit that changed bodies. Until GoOn the world's tick is that one.
  void GoBackTo(std::int64_t tick);
  /// What is shown is carried over to what the bodies became.
  void Remap(const BodyRemap& change);
  /// `changed`: bodies are others now, and there is no way back to before this edit. Others are
  /// done again by each replay that comes to their tick.
  void Edited(const Edit& edit, bool changed);
  /// Whether a peer that had applied only the first `revision` edits lacked one that acted before
  /// `tick`: what it says of that tick is of a world in which that has not happened.
  bool LacksEdit(int revision, std::int64_t tick) const;
  /// Steps again to now.
  void GoOn();
  /// The tick to which GoOn will come; the world's while it did not go back.
  std::int64_t now() const { return journey_ ? journey_->now : world_.tick(); }

  std::int64_t ticks_stepped_again() const { return stepped_again_; }
  /// Calls of Run that left their replay for the next.
  std::int64_t deferred() const { return deferred_; }

 private:
  struct Action {
    std::int64_t tick = 0;
    int player = 0, action = 0;
  };

  struct Barrier {
    WorldSnapshot world;
    std::int64_t edits = 0;  ///< how many of those that changed no bodies were applied before it
  };
  /// An edit that changed no bodies.
  struct Repeated {
    Edit edit;
    std::int64_t tick = 0;
    int sat = -1;  ///< of a seat: who sat there before
  };

  bool RestsAsBefore(int body, const BodyState& pose);
  /// What is shown of a body before it is stepped again.
  struct Shown {
    int body = -1;
    BodyState state;
    bool awake = true;
  };
  struct Journey {
    std::int64_t from = 0, now = 0;
    std::vector<Shown> shown;  // ascending; of GoBackTo: of all bodies that were there
  };

  /// Whether an edit is between the tick and now: moved on without it, a state says nothing of now,
  /// and newer ones are on their way.
  bool IsBeforeEdit(std::int64_t tick) const;
  bool Depart(std::int64_t from, bool all);
  void PutIdle();
  void StepTo(std::int64_t tick);
  void Arrive();
  void BarrierAfterEdits();
  void AddBarrier(bool alone);
  /// Whether nothing that this peer steps is stepped, or moved by inputs, by another.
  bool IsAlone() const;
  void DropBarriers();
  void NoteSitters();
  void ForgetHeard();
  void UndoEdits();
  void RepeatEdits();
  bool BeginsEarlier(int body, std::int64_t tick);
  void FindPressed(std::int64_t from);
  bool FollowsHistory(int body, std::int64_t tick) const;
  bool IsFact(int body, std::int64_t tick) const;
  /// Whether a difference is one that stays as it is.
  bool Agrees(const BodyState& difference) const;
  void EndRest();
  void PutIn();
  void PutIn(int body);
  void StepAgain();
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
  std::int64_t edits_before_ = 0;                     // how many have been forgotten
  std::int64_t edits_done_ = 0;                       // how many the world has had
  std::deque<std::pair<int, std::int64_t>> applied_;  // revisions and ticks; both ascend
  std::vector<int> sitters_;                          // by seat, as of the last edit
  std::deque<Action> actions_;                        // since the first barrier
  std::int64_t from_ = -1;                            // oldest tick asked for, -1 none
  std::vector<bool> pressed_;                         // by mechanism, of the replay that runs
  bool was_alone_ = false;                            // at the send tick before
  double credit_ = 0;                                 // ticks that may be stepped again
  std::function<void()> on_stepped_again_ = [] {};
  std::optional<Journey> journey_;  // while the world is in the past
  std::int64_t edited_tick_ = -1;   // of the last edit that changed bodies, -1 none
  bool edited_ = false;             // since the last step, so that bodies are others
  std::int64_t stepped_again_ = 0;
  std::int64_t deferred_ = 0;
};

}  // namespace seam
