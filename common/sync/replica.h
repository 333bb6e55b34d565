#pragma once
/// One peer's copy of a room: a world, what it knows of the others, and the rules that keep the
/// copy near theirs. Server and clients each have one; it knows nothing of time, sockets or files.
///
///   Receive(States), ApplyGrants, NoteInputs          between steps
///   Step: inputs -> kinematic bodies -> World::Step -> quantise and collect own States -> history
///   TakeStates, MakeView, MakeImpacts                 after it

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "common/physics/history.h"
#include "common/physics/world.h"
#include "common/sync/authority.h"
#include "common/sync/input_track.h"
#include "common/sync/mode.h"
#include "common/sync/quantize.h"
#include "common/sync/smoother.h"
#include "common/sync/snapshots.h"

namespace seam {

class Replica {
 public:
  /// `self`: peer number. `own_player`: the player whose vehicle this peer predicts in mode
  /// central, or -1.
  Replica(const Scene& scene, const SyncConfig& config, int self, int own_player);

  /// Begins (or, after an absence, goes on) at `tick`. Beginning at 0 all bodies are where the
  /// scene puts them; later, each body waits for its first state and is placed there.
  void StartAt(std::int64_t tick);
  std::int64_t tick() const { return world_.tick(); }

  const Scene& scene() const { return world_.scene(); }
  World& world() { return world_; }
  const World& world() const { return world_; }
  const AuthorityTable& authority() const { return table_; }
  /// The server plans here; clients only follow grants.
  AuthorityTable& authority() { return table_; }
  /// kRoleAuthority, kRoleSecondary or kRoleRemote of this peer for a mechanism.
  std::int8_t RoleOf(int mechanism) const;

  /// Edits that the server ordered, in their order; they are applied before anything else is done.
  /// False, and ignored: it is not the next one.
  bool Queue(const EditOrder& order);
  bool has_queued() const { return !queued_.empty(); }
  /// Applies the next that is queued. What became of the bodies; nullopt: they are what they were.
  /// One by one everywhere: each merger makes a new epoch, and who applied two at once would be an
  /// epoch behind for ever. Requires has_queued().
  std::optional<BodyRemap> ApplyNextEdit();
  void ApplyEdits();  ///< all that is queued
  /// What this peer, as the authority of the bodies concerned, found that should change; in mode
  /// oracle all that physics finds.
  std::vector<Edit> TakeProposals();
  /// Whether the body is made of what it was made of after that many edits.
  bool SameBody(int body, int edits) const {
    return changed_at_[static_cast<std::size_t>(body)] <= edits;
  }
  int revision() const { return world_.topology().revision(); }

  /// Follows the server's word. Returns the mechanisms whose authority changed hands.
  std::vector<int> ApplyGrants(const Grants& grants);
  /// After Set on authority(): lets motion types follow the roles.
  void RolesChanged();
  /// Gives up every authority (the server has not been heard for too long).
  void ReleaseAll();

  /// Buttons of this player that went down since the last call, as far as heard of.
  int TakePressed(int player) {
    return std::exchange(pressed_now_[static_cast<std::size_t>(player)], 0);
  }
  InputTrack& inputs(int player) { return tracks_[static_cast<std::size_t>(player)]; }

  /// What became of the bodies of a States message.
  struct Received {
    int used = 0;
    int stale = 0;    ///< older than what is known, or of an old epoch
    int unknown = 0;  ///< no such body, or this peer's own
  };
  /// States of another peer's bodies. Those of ticks still to come wait for them.
  Received Receive(const States& states);
  /// Like Receive, but takes poses as they are: the room as it is now, for one who joins late.
  void Place(const States& states);

  void Step();

  /// What this peer has to tell after the last Step: empty unless a send is due. utime is left 0.
  std::vector<States> TakeStates();
  /// The current state of all bodies (of the authorities this peer is or follows), for a joiner.
  std::vector<States> Everything() const;
  View MakeView() const;
  /// Impacts of the last tick above the major threshold; ids empty when there were none.
  Impacts MakeImpacts() const;

  double display_delay_ticks() const { return delay_.ticks(); }

 private:
  void ApplyInputs(std::int64_t next);
  void DriveKinematic(std::int64_t next);
  BodyState AlongSnapshots(int body, const BodyState& target, BodyState state);
  BodyState AlongReckoned(int body, std::int64_t next, BodyState state);
  void NoteImpacts();
  void NoteTouches();
  /// Notes one entry; true if its body is simulated here and to be corrected.
  bool ReceiveOne(const States& states, std::size_t i, int body);
  /// Mass-weighted mean of Xr(t1) - Xl(t1) by mechanism.
  std::map<int, BodyState> CommonDifferences(
      const States& states, const std::vector<std::pair<std::size_t, int>>& entries) const;
  /// Our copy at an earlier tick; nullptr when it is not comparable with the authority's.
  const BodyState* PastOf(int body, std::int64_t tick) const;
  /// PastOf with the velocity of the near tick at which our copy moved most like `remote`.
  BodyState LikePastOf(int body, std::int64_t tick, const BodyState& remote) const;
  void Correct(int body, const States& states, std::size_t i, const BodyState& common);
  void Predict(const States& states);
  // Rules that act in every tick (replica_pull.cpp).
  BodyState PullTarget(int body, std::int64_t at) const;
  void NoteArrival(int body);
  void PullCopies(std::int64_t next);
  // Going back and stepping again (replica_resimulate.cpp).
  /// Asks for a replay from `tick`, of which a state of `body` came; false: it cannot be had.
  bool ReplayFrom(int body, std::int64_t tick);
  void TakeBarrier();
  /// By mechanism: whether it touches bodies of other authorities, without a blow since `from`.
  std::vector<bool> FindPressed(std::int64_t from) const;
  bool FollowsHistory(int body, std::int64_t tick) const;
  void PutIn();
  void StepAgain();
  void Resimulate();
  void RecordHistory();
  void NoteProposals();
  void Remap(const BodyRemap& change);
  std::vector<PackedBody> ChooseBodies();
  States Header() const;
  bool Simulated(int mechanism) const;
  float GainFor(float dt) const;

  SyncConfig config_;
  int self_;
  int own_player_;
  World world_;
  AuthorityTable table_;
  History history_;
  Smoother smoother_;
  Snapshots snapshots_;
  DisplayDelay delay_;
  std::vector<InputTrack> tracks_;
  std::vector<int> pressed_now_;                 // by player
  std::vector<States> early_;                    // of ticks still to come
  std::vector<std::int64_t> last_impact_tick_;   // by body
  std::vector<std::int64_t> last_coupled_tick_;  // by mechanism
  std::vector<std::int64_t> heard_tick_;         // by body: newest state heard, -1 never
  std::vector<std::int64_t> dynamic_since_;  // by body: its history tells of forces from here on
  std::vector<bool> placed_;                 // by body: pose is known
  std::vector<float> priority_;              // by body: accumulator for sending
  std::vector<std::int64_t> asleep_since_;   // by body, -1 awake
  std::vector<States> outgoing_;
  struct Pull {
    std::int64_t arrived = -1;  // tick of the newest message's arrival, -1 none
    BodyState arrival;          // our copy then
    BodyState target_then;      // where the authority's was thought to be then
    PullMemory memory;
  };
  std::vector<Pull> pulls_;             // by body; empty without such a rule
  std::deque<WorldSnapshot> barriers_;  // ascending; empty unless the rule goes back
  std::int64_t replay_from_ = -1;       // oldest tick to go back to, -1 none
  std::vector<bool> pressed_;           // FindPressed of the last replay
  struct Acted {
    std::int64_t tick = 0;
    int player = 0, action = 0;
  };
  std::vector<Edit> queued_;     // ordered, not yet applied
  std::vector<int> changed_at_;  // by body: edits there were when it was last changed
  std::vector<Edit> proposals_;
  std::map<EditKey, std::int64_t> proposed_;  // when, by what
  std::deque<Acted> acted_;  // pushes that this peer did since the first barrier
};

/// Dead reckoning beyond the buffer zone goes no further than this, s. Shorter than the age of what
/// is heard, and a fast body stops and jumps; longer shows more of what is not so.
constexpr float kReckonMax = 1.0f;

/// A change of velocity that counts as a major impact for `fade`, m/s. A driven wheel feels up to
/// 2.6 m/s from the ground in every tick: lower lets it count as colliding all the time; higher
/// lets real collisions be overruled by old news.
constexpr float kMajorImpact = 3.0f;

}  // namespace seam
