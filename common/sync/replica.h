#pragma once
/// One peer's copy of a room: a world, what it knows of the others, and the rules that keep the
/// copy near theirs. Server and clients each have one; it knows nothing of time, sockets or files.
///
///   Queue, ApplyGrants, Receive, NoteInputs      between steps
///   Step: edits -> replay -> inputs -> displayed bodies -> pulls -> World::Step -> contacts noted,
///         proposals, own States collected -> history -> States that waited
///   TakeStates, TakeProposals, MakeView, MakeImpacts      after it
///
/// Its parts: Roles (what it is to each mechanism), Presence (which of the others' its world has to
/// have), BodyMemory (what it remembers of its bodies), Display, Corrector and Replay (which move
/// bodies), Reach (what inputs that are still unknown can have changed), SendScheduler and
/// ProposalQueue (what it tells). This class calls them in order and has no rule of its own.

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "common/physics/world.h"
#include "common/sync/body_memory.h"
#include "common/sync/correct/corrector.h"
#include "common/sync/correct/replay.h"
#include "common/sync/display.h"
#include "common/sync/impact_reporter.h"
#include "common/sync/input_track.h"
#include "common/sync/mode.h"
#include "common/sync/proposal_queue.h"
#include "common/sync/reach/driven.h"
#include "common/sync/reach/presence.h"
#include "common/sync/reach/reach.h"
#include "common/sync/rest/rest_commit.h"
#include "common/sync/roles.h"
#include "common/sync/send_scheduler.h"
#include "common/sync/show/strand_view.h"

namespace seam {

class Replica {
 public:
  /// `self`: peer number. `own_player`: the player whose vehicle this peer predicts in mode
  /// central, or -1.
  Replica(const Scene& scene, const SyncConfig& config, int self, int own_player)
      : Replica(Topology(scene), config, self, own_player) {}
  /// Begins with a scene as it has become by edits.
  Replica(const Topology& topology, const SyncConfig& config, int self, int own_player);

  /// Begins (or, after an absence, goes on) at `tick`. Beginning at 0 all bodies are where the
  /// scene puts them; later, each body waits for its first state and is placed there.
  void StartAt(std::int64_t tick);
  /// After StartAt, when all that is known of then is placed: from there it can be stepped again.
  void Begin();
  /// After StartAt, for a world that replaces another: what `before` has too goes on from where it
  /// is there, until it is heard of.
  void GoOnFrom(const World& before);
  std::int64_t tick() const { return world_.tick(); }
  void Step();

  const World& world() const { return world_; }
  const AuthorityTable& authority() const { return roles_.table(); }
  /// The server plans here; clients only follow grants.
  AuthorityTable& authority() { return roles_.table(); }
  /// After Set on authority(): lets motion types follow the roles.
  void RolesChanged() {
    FollowRoles();
    rest_.PutBack();
  }
  /// See Presence::LeaveUnwatched.
  void LeaveUnwatched(std::vector<char> unwatched, const PeerSet& doubtful) {
    presence_.LeaveUnwatched(std::move(unwatched), doubtful);
  }
  const Drivers& drivers() const { return drivers_; }
  /// Follows the server's word. Returns the mechanisms that this peer had authority over and has no
  /// longer.
  std::vector<int> ApplyGrants(const Grants& grants);
  /// Where the bodies of the mechanisms were that ApplyGrants took from this peer since the last
  /// call, bit for bit: then, or as MakeExact says. utime is left 0.
  std::vector<ExactStates> TakeReleased() { return std::exchange(released_, {}); }
  /// The same of mechanisms that this peer has now, with an epoch on from theirs: for who gets
  /// them. Where peers go back for inputs, as they were at the newest tick that none still to come
  /// can change.
  std::vector<ExactStates> MakeExact(const std::vector<int>& mechanisms,
                                     std::int32_t epochs_on) const;
  /// What another peer let go of. How far this copy was from it, at most; see Corrector::TakeOver.
  BodyState TakeOver(const ExactStates& exact);
  /// How far this peer's copies were from what was received, where it simulated them at that tick:
  /// calls `call(body, off)`.
  void EachOff(const States& states, const std::function<void(int, const BodyState&)>& call) const;
  /// The server only; see Roles::SpeakFor.
  void SpeakFor(const PeerSet& silent) { roles_.SpeakFor(silent); }
  /// Gives up every authority (the server has not been heard for too long).
  void ReleaseAll();

  /// Edits that the server ordered, in their order; they are applied before anything else is done,
  /// each after the tick that the order names: peers that go back do so, for others, and for what
  /// is too old, it is now; for a tick still to come they wait.
  /// False, and ignored: it is not the next one.
  /// In mode oracle every peer edits alone: what physics found is queued by Step, the server's
  /// order of the same edit is ignored, and one from outside is queued by the Step of the tick it
  /// names.
  bool Queue(const EditOrder& order);
  /// Whether one is to be applied now: its tick has come.
  bool has_queued() const;
  /// The next to be applied. Requires has_queued().
  const Edit& next_queued() const { return queued_.front().edit; }
  /// Applies all that is queued and whose tick has come.
  void ApplyEdits();
  /// Applies the next that is queued. What became of the bodies; nullopt: they are what they were.
  /// Each merger of mechanisms begins a new epoch, so all peers apply edits one by one: one that
  /// applied two at once would stay an epoch behind. Requires has_queued().
  std::optional<BodyRemap> ApplyNextEdit();
  /// What this peer, as the authority of the bodies concerned, found that should change; in mode
  /// oracle all that physics finds.
  std::vector<FoundEdit> TakeProposals() { return proposals_.Take(); }
  /// Whether the body is made of what it was made of after that many edits.
  bool SameBody(int body, int edits) const { return memory_.track(body).changed_at <= edits; }
  /// Whether our copy of what another has was simulated here already when the newest state of it
  /// came; else it has begun from that state, without what a state does not tell.
  bool SimulatedBefore(int body) const {
    const BodyTrack& track = memory_.track(body);
    return track.dynamic_since < track.heard_tick;
  }
  /// Edits applied so far.
  int revision() const { return world_.topology().revision(); }
  /// Ticks that were stepped again, and replays that waited since the budget was used up.
  std::int64_t ticks_stepped_again() const { return replay_.ticks_stepped_again(); }
  std::int64_t replays_deferred() const { return replay_.deferred(); }
  /// Calls `call(body)` for each correction: a body's physics state was changed by more than the
  /// wire's rounding, by what was heard.
  void OnCorrected(std::function<void(int)> call) { display_.OnCorrected(std::move(call)); }

  const InputTrack& inputs(int player) const { return inputs_[static_cast<std::size_t>(player)]; }
  /// What a player does in a tick still to come, or did in one that is known late.
  void NoteInput(int player, std::int64_t tick, const Input& input);
  void NoteInputs(const Inputs& inputs);
  /// Buttons of this player that went down since the last call, as far as heard of.
  int TakePressed(int player) {
    return std::exchange(pressed_now_[static_cast<std::size_t>(player)], 0);
  }

  /// States of another peer's bodies. Those of ticks or edits still to come wait for them.
  Received Receive(const States& states);
  /// Like Receive, but takes poses as they are: the room as it is now, for one who joins late.
  void Place(const States& states);

  /// What this peer has to tell after the last Step: empty unless a send is due. utime is left 0.
  std::vector<States> TakeStates() { return scheduler_.Take(); }
  /// The current state of all bodies that are not committed to rest, for one who joins late.
  std::vector<States> Everything() const { return scheduler_.Everything(); }
  /// What its authorities have committed to rest (RestCommit): received, to be told after a step,
  /// and for comparison with another peer's.
  RestCommit& rest() { return rest_; }
  const RestCommit& rest() const { return rest_; }
  /// Takes what another peer's authority has committed to rest.
  void Receive(const Rest& rest);
  /// Of all bodies, or of those that this peer simulates.
  View MakeView(bool all = true) const { return display_.MakeView(roles_, all); }
  /// Of the scene's strands, as a view of this tick shows them; no points: there are none.
  Strands MakeStrands(const View& view) { return strands_.Next(view); }
  /// Impacts of the last tick above kMajorImpact, the first 64; ids empty when there were none.
  Impacts MakeImpacts() const;
  /// Of the steps since the last call: impacts that can hurt what this peer has authority over.
  std::vector<ImpactReport> TakeImpactReports() { return impact_reporter_.Take(); }

 private:
  friend struct ReplicaTestAccess;

  /// An edit that is to be applied after a tick.
  struct QueuedEdit {
    Edit edit;
    std::int64_t tick = 0;
  };
  /// A proposal whose order is awaited, and where it is.
  struct Awaited {
    EditKey key{};
    std::vector<PartId> parts;
    std::int64_t tick = 0;
  };

  void FollowRoles();
  /// Ascending.
  std::vector<int> BodiesOf(const std::vector<int>& mechanisms) const;
  void QueueAppointed();
  /// After a step, also one that is done again: what physics found that should change.
  void FindEdits();
  /// Whether another edit of its mechanism is awaited: what is found meanwhile is found in a world
  /// in which that has not happened.
  bool IsHeldBack(const Edit& edit, std::int64_t found);
  /// Of what was found: where inputs are stamped that waits until its tick is input-complete.
  /// Before that it is an assumption, and an edit cannot be taken back.
  void ProposeFound();
  bool IsComplete(const Edit& edit, std::int64_t found) const;
  /// Whether it was.
  bool Propose(Edit edit, std::int64_t found);
  void Remap(const BodyRemap& change);
  /// Of joints that the edit takes away: a later bond may take their places, and break at once.
  void ForgetProposals(const Edit& edit);
  void ApplyInputs(std::int64_t next);
  void NeedDriven(int player);
  void ApplyPresses(int player, std::int64_t next);

  // In this order: each uses those above it.
  SyncConfig config_;
  World world_;
  Roles roles_;
  Drivers drivers_;
  BodyMemory memory_;
  Presence presence_;
  std::vector<InputTrack> inputs_;  // by player
  Display display_;
  StrandView strands_;
  Replay replay_;
  Corrector corrector_;
  Reach reach_;
  RestCommit rest_;
  SendScheduler scheduler_;
  ProposalQueue proposals_;
  ImpactReporter impact_reporter_;
  std::vector<int> heard_players_;                   // whose inputs were heard of, or are to come
  std::vector<int> pressed_now_;                     // by player
  std::vector<int> pressed_missed_;                  // by player: heard of too late to go back to
  std::vector<QueuedEdit> queued_;                   // ordered, not yet applied; ticks ascend
  std::map<std::int64_t, std::vector<Edit>> found_;  // not yet proposed, by tick
  std::vector<Awaited> awaited_;                     // where this peer goes back
  std::map<std::int64_t, std::vector<Edit>> appointed_;  // mode oracle: from outside, by tick
  std::vector<ExactStates> released_;                    // of what ApplyGrants took, not yet told
};

}  // namespace seam
