#pragma once
/// One peer's copy of a room: a world, the knowledge received from other peers, and the rules that
/// keep all copies near each other. Server and clients each have one. It knows nothing of time,
/// sockets or files.
///
///   Queue, ApplyGrants, Receive, RecordInputs      between steps
///   Step: edits -> replay -> inputs -> displayed bodies -> pulls -> World::Step -> contacts noted,
///         proposals, own States collected -> history -> States that waited
///   TakeStates, TakeProposals, MakeView, MakeImpacts      after it
///
/// Its parts: Roles (its role for each mechanism), Activities (the
/// activity of each body), BodyMemory (records per body), Display, Corrector and Replay (which move
/// bodies), Reach (effects of inputs still unknown), SendScheduler and ProposalQueue (messages to
/// send). This class calls them in order and has no rule of its own.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "common/codec/packed/packed_states.h"
#include "common/physics/world.h"
#include "common/sync/audit/divergences.h"
#include "common/sync/body_memory.h"
#include "common/sync/correct/corrector.h"
#include "common/sync/display.h"
#include "common/sync/edits/edit_queue.h"
#include "common/sync/impact_reporter.h"
#include "common/sync/inputs/complete_inputs.h"
#include "common/sync/inputs/input_track.h"
#include "common/sync/mode.h"
#include "common/sync/proposal_queue.h"
#include "common/sync/reach/activities.h"
#include "common/sync/reach/driven.h"
#include "common/sync/reach/reach.h"
#include "common/sync/rest/rest_commit.h"
#include "common/sync/roles.h"
#include "common/sync/rollback/new_touches.h"
#include "common/sync/rollback/replay.h"
#include "common/sync/send_scheduler.h"
#include "common/sync/show/strand_view.h"
#include "common/sync/table/body_table.h"

namespace seam {

class Replica {
 public:
  /// `self`: peer number. `own_player`: the player whose vehicle this peer predicts in mode
  /// central, or -1.
  Replica(const Scene& scene, const SyncConfig& config, int self, int own_player)
      : Replica(Topology(scene), config, self, own_player) {}
  /// Begins with a scene as changed by edits.
  Replica(const Topology& topology, const SyncConfig& config, int self, int own_player);
  /// Displays others' bodies at most so many ticks ago from now on: SyncConfig::show_age_ticks.
  void ShowAtMost(int age_ticks) { config_.show_age_ticks = age_ticks; }

  /// Begins (or, after an absence, continues) at `tick`. At 0 all bodies are where the scene puts
  /// them; later, each body waits for its first state and is placed there.
  void StartAt(std::int64_t tick);
  /// Call after StartAt, when all states of that tick are placed. Replays can go back to this tick.
  void Begin();
  /// Call after StartAt for a world that replaces another. Bodies that `before` has too continue
  /// from their states there until they are heard of.
  void GoOnFrom(const World& before);
  std::int64_t tick() const { return world_.tick(); }
  void Step();
  /// kAll: for a copy that will still hear of ticks that are over.
  enum class Past { kNone, kAll };
  /// Saves or loads all that decides how this copy continues: bodies, roles, inputs, rest, edits
  /// found, and so much of the past and of the states heard. Not saved: the view. Call between
  /// ticks with no edit queued. Writing makes this tick a barrier (World::Barrier). Reading
  /// requires a new replica of the same topology and config, and takes either past; after an error
  /// it must not be used any more.
  void Persist(StateArchive& a, Past past);

  const World& world() const { return world_; }
  /// The table of the world's bodies and mechanisms, for columns of readers. They must not outlive
  /// this.
  const BodyTable& table() const { return table_; }
  const AuthorityTable& authority() const { return roles_.table(); }
  /// The server plans here; clients only apply grants.
  AuthorityTable& authority() { return roles_.table(); }
  /// See Roles.
  bool CopiesAgree(int mechanism) const { return roles_.CopiesAgree(mechanism); }
  bool RefreshesOnly(int mechanism) const { return roles_.RefreshesOnly(mechanism); }
  /// Returns the ids of mechanisms of which received states differ from this peer's copies, for
  /// their authority.
  std::vector<std::int32_t> TakeDiffering() { return memory_.TakeDiffering(); }
  /// Another peer's copies differ from the states of these: every send has them for kSettleS.
  void NoteDiffering(const Differing& differing);
  /// Call after Set on authority(). Updates activities to the roles.
  void RolesChanged() {
    FollowRoles();
    rest_->PutBack();
  }
  /// See Activities::AllowDormant.
  void AllowDormant(std::vector<char> allowed, const PeerSet& uncertain) {
    activities_.AllowDormant(std::move(allowed), uncertain);
  }
  const Drivers& drivers() const { return drivers_; }
  /// Applies the server's grants. Returns the mechanisms over which this peer lost authority.
  std::vector<int> ApplyGrants(const Grants& grants);
  /// Returns the exact states of the mechanisms that ApplyGrants took from this peer since the last
  /// call, at that time or as in MakeExact. utime is left 0.
  std::vector<ExactStates> TakeReleased() { return std::exchange(released_, {}); }
  /// Returns the exact states of mechanisms that this peer holds, with their epochs raised by
  /// `epochs_on`, for their next holder. With rollback, at the newest tick that no future input can
  /// change.
  std::vector<ExactStates> MakeExact(const std::vector<int>& mechanisms,
                                     std::int32_t epochs_on) const;
  /// Takes over another peer's released states. Returns the largest difference from this copy; see
  /// Corrector::TakeOver.
  BodyState TakeOver(const ExactStates& exact);
  /// Returns the newest world, of ticks `from` to `to`, that no input can change any more, for a
  /// peer of the same edits; empty if there is none yet, or if this peer only displays some body.
  Bytes SettledWorld(std::int64_t from, std::int64_t to) const;
  /// Goes on from another peer's settled world, to the last bit, if its tick can be reached and
  /// this peer simulates all bodies, too. Returns an error if it is no such world.
  Status TakeWorld(ByteView settled);
  /// Calls `call(body, off)` with the difference between received states and this peer's copies,
  /// for bodies that it simulated at that tick.
  void EachDifference(const States& states,
                      const std::function<void(int, const BodyState&)>& call) const;
  /// Returns this peer's copy of a body at a tick if it simulated it, and all inputs that can have
  /// moved it are known and acted on; else nullptr. Valid until the next call that changes this.
  const BodyState* SettledPast(int body, std::int64_t tick) const;
  /// Like above, of a peer's state after `revision` edits; nullptr also if that peer lacked an edit
  /// of that time, or if this copy rests on a guess: on dead reckoning, or on a world that a late
  /// input could no longer change. The next state heard of the body ends that.
  const BodyState* ComparablePast(int body, std::int64_t tick, int revision) const;
  /// True if, in the last kHistory s, something was heard of a time before an edit, too late to be
  /// acted on here. Copies have then gone on from states that were told, rounded by the wire and
  /// without impulses: small differences say nothing.
  bool FollowsTold() const;
  /// True if edits alone keep a peer's state from being compared: that peer lacked one, or nothing
  /// was heard of the body since the last time that something came too late (FollowsTold).
  bool EditHidesPast(int body, std::int64_t tick, int revision) const;
  /// True if this peer's own world broke the joint within a quarter of a second of the tick.
  bool FeltBreak(int joint, std::int64_t tick) const;
  /// Server only; see Roles::SetSilentHolders.
  void SetSilentHolders(const PeerSet& silent) { roles_.SetSilentHolders(silent); }
  /// Gives up all authority (the server has not been heard for too long).
  void ReleaseAll();

  /// Queues an edit ordered by the server. Queued edits are applied in order and before anything
  /// else, each after the tick that its order names. A peer that rolls back goes back to that tick;
  /// other peers, and orders too old for a replay, apply it now; an order of a future tick waits.
  /// Returns false, and ignores the order, if it is not the next one.
  bool Queue(const EditOrder& order);
  /// True if the next queued edit is due.
  bool has_queued() const;
  /// True if any edit is queued, also one that is not due.
  bool edits_pending() const { return queue_->size() > 0; }
  /// The next edit to apply. Requires has_queued().
  const Edit& next_queued() const { return queue_->front().edit; }
  /// Applies all queued edits that are due.
  void ApplyEdits();
  /// Applies the next queued edit; if it changes bodies, renumbers all columns of table(). Each
  /// merger of mechanisms begins a new epoch, so all peers apply edits one by one: a peer that
  /// applied two at once would stay an epoch behind. Requires has_queued().
  void ApplyNextEdit();
  /// Returns the edits that this peer found as the authority of the affected bodies.
  std::vector<FoundEdit> TakeProposals() { return proposals_.Take(); }
  /// True if the body has had the same parts since revision `edits`.
  bool SameBody(int body, int edits) const { return memory_.track(body).changed_at <= edits; }
  /// True if a copy was simulated here before its newest state came; otherwise it started from that
  /// state, and lacks the parts of a state that the wire does not carry.
  bool SimulatedBefore(int body) const {
    const BodyTrack& track = memory_.track(body);
    return track.dynamic_since < track.heard_tick;
  }
  /// Number of edits applied so far.
  int revision() const { return world_.topology().revision(); }
  /// Ticks stepped again, and replays deferred because the budget was used up.
  std::int64_t ticks_stepped_again() const { return replay_.ticks_stepped_again(); }
  std::int64_t replays_deferred() const { return replay_.deferred(); }
  /// Calls `call(body)` for each correction: a change of a body's simulated state by more than the
  /// wire's rounding, caused by messages.
  void OnCorrected(std::function<void(int, const BodyState&)> call) {
    display_.OnCorrected(std::move(call));
  }

  const InputTrack& inputs(int player) const { return inputs_[static_cast<std::size_t>(player)]; }
  /// Records a player's input of a future tick, or a late one of a past tick.
  void RecordInput(int player, std::int64_t tick, const Input& input);
  void RecordInputs(const Inputs& inputs);
  /// True if the mode lets this peer do its next tick with the inputs that it knows by now.
  bool MayStep() const {
    const std::int64_t most = config_.policy->MostAhead(roles_.self());
    return most >= Policy::kAnyTicks || tick() < complete_.Tick() + most;
  }
  /// Returns a hash of all bodies' states after a tick, which no input can change any more. nullopt
  /// of later ticks, of forgotten ones, and of those before the last edit of bodies.
  std::optional<std::uint64_t> PastHash(std::int64_t tick) const;
  /// The newest tick of which PastHash may know the hash.
  std::int64_t newest_past() const {
    return std::min({tick(), complete_.Tick(), replay_.settled()});
  }
  /// Returns the buttons of this player that went down since the last call, as far as known.
  int TakePressed(int player) {
    return std::exchange(pressed_now_[static_cast<std::size_t>(player)], 0);
  }

  /// Takes states of another peer's bodies. States of future ticks or edits are kept until then.
  Received Receive(const States& states);
  /// Takes the room's current states, for a peer that joins late: only unplaced bodies are placed.
  void Place(const States& states);

  /// Returns the states to send after the last Step; empty unless a send is due. utime is left 0.
  std::vector<States> TakeStates() { return scheduler_.Take(); }
  /// Returns the current state of all bodies that are not committed to rest, for a peer that joins
  /// late.
  std::vector<States> Everything() const { return scheduler_.Everything(); }
  /// The rest commitments of all authorities (RestCommit): receives them, returns those to send
  /// after a step, and compares them with another peer's.
  RestCommit& rest() { return *rest_; }
  const RestCommit& rest() const { return *rest_; }
  /// Takes rest commitments of another peer.
  void Receive(const Rest& rest);
  /// Returns the view of all bodies, or of those that this peer simulates.
  View MakeView(bool all = true) const { return display_.MakeView(roles_, all); }
  /// Returns the scene's strands as a view of this tick shows them; empty if there are none.
  Strands MakeStrands(const View& view) { return strands_.Next(view); }
  /// Returns the last tick's impacts above kMajorImpact, the first 64; ids are empty if there were
  /// none.
  Impacts MakeImpacts() const;
  /// Returns the impacts since the last call that can hurt bodies under this peer's authority.
  std::vector<ImpactReport> TakeImpactReports() { return impact_reporter_.Take(); }
  /// Remembers from now on which told states differ from this peer's own (Divergences).
  void WatchDivergences() { divergences_ = std::make_unique<Divergences>(); }
  /// Compares what a holder tells with the past of that tick, believed or not.
  void NoteDivergences(const States& states);
  /// Returns the differences since the last call; nullopt: none, or they are not watched.
  std::optional<Divergence> TakeDivergence(std::int64_t now_us);
  /// Finds the touches of parts from the next step on.
  void WatchTouches() { world_.WatchTouches(); }
  /// See NewTouches; both empty without WatchTouches.
  std::vector<NewTouch> TakeTouches() { return touches_.Take(); }
  std::vector<TouchReport> TakeTouchReports() { return touches_.TakeReports(); }

 private:
  friend struct ReplicaTestAccess;

  /// A proposal whose order is pending, with its parts and tick.
  struct Awaited {
    EditKey key{};
    std::vector<PartId> parts;
    std::int64_t tick = 0;
  };

  void FollowRoles();
  /// Returns body indices, ascending.
  std::vector<int> BodiesOf(const std::vector<int>& mechanisms) const;
  /// Call after a step, also one of a replay. Finds edits proposed by physics.
  void FindEdits();
  /// True if another edit of the edit's mechanism is pending: this one was found in a world without
  /// that edit.
  bool AwaitsOtherEdit(const Edit& edit, std::int64_t found);
  /// Proposes the edits found. Where inputs are stamped, an edit waits until its tick is
  /// input-complete: before that it rests on an assumption, and an edit cannot be undone.
  void ProposeFound();
  bool IsComplete(const Edit& edit, std::int64_t found) const;
  /// Returns true if the edit was queued.
  bool Propose(Edit edit, std::int64_t found);
  /// Returns false, with an error in `a`, if the world cannot continue from `now`.
  bool LoadWorld(const WorldSnapshot& now, StateArchive& a);
  void PersistEdits(StateArchive& a);
  /// Forgets proposals of joints that the edit removes: a later bond may take their places and
  /// break at once.
  void ForgetProposals(const Edit& edit);
  void ApplyInputs(std::int64_t next);
  void NeedDriven(int player);
  void ApplyPresses(int player, std::int64_t next);

  // Order matters: each uses members above it.
  SyncConfig config_;
  World world_;
  BodyTable table_;
  Roles roles_;
  Drivers drivers_;
  BodyMemory memory_;
  Activities activities_;
  std::vector<InputTrack> inputs_;  // by player
  CompleteInputs complete_{inputs_};
  Display display_;
  StrandView strands_;
  Replay replay_;
  Corrector corrector_;
  Reach reach_;
  std::unique_ptr<RestCommit> rest_;
  SendScheduler scheduler_;
  std::unique_ptr<EditQueue> queue_;
  ProposalQueue proposals_;
  ImpactReporter impact_reporter_;
  NewTouches touches_;
  std::unique_ptr<Divergences> divergences_;         // null: not watched
  std::vector<int> heard_players_;                   // players with new or future inputs
  std::vector<int> pressed_now_;                     // by player
  std::vector<int> pressed_missed_;                  // by player: presses that came too late for a
                                                     // replay
  std::int64_t taken_tick_ = -1;                     // of the last world taken: the inputs until
                                                     // then have acted in it
  std::map<std::int64_t, std::vector<Edit>> found_;  // not yet proposed, by tick
  std::vector<Awaited> awaited_;                     // pending proposals; only if this peer rolls
                                                     // back
  std::map<int, std::int64_t> felt_breaks_;          // newest tick, by joint
  std::vector<ExactStates> released_;                // states that ApplyGrants released, not
                                                     // yet sent
};

}  // namespace seam
