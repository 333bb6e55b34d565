#pragma once
/// Server-side authority over mechanisms: applies the plan with one authority at a time, and
/// returns the grants to send. Sends nothing itself.

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "common/sync/replica.h"
#include "common/sync/table/body_column.h"
#include "common/sync/table/mechanism_column.h"
#include "server/authority/capacity_watch.h"
#include "server/authority/plan.h"
#include "server/authority/sleeping_index.h"

namespace seam {

class StateArchive;

class AuthorityManager {
 public:
  /// Writes the authority table of `replica`; both `scene` and `replica` must outlive this object.
  /// At first the server has authority over everything; in mode buffer it is also a follower of
  /// everything, so that it can take over at any moment.
  AuthorityManager(const Scene& scene, const SyncConfig& config, Replica& replica);

  /// Per-tick inputs of the planner that come from outside.
  struct PlannerInputs {
    std::vector<int> peer_of_player;         ///< by player; -1: no client is ready to drive it
    std::vector<float> one_way_s;            ///< s, by player, from the server; empty: all 0
    /// By player: what was queued until then is sent to its peer, us (Link::SentUntilUs). Empty:
    /// now.
    std::vector<std::int64_t> sent_us;
    PeerSet silent;                          ///< peers not heard from for kSilentUs
    PeerSet untrusted;                       ///< peers that may have no authority
    std::vector<std::vector<int>> together;  ///< see AuthorityView
    /// By player: share of real time that its peer needs for its ticks; below 0: unknown. Empty:
    /// unknown for all.
    std::vector<float> load;
    /// True if someone displays the server's view: see Scene::server_follow.
    bool shown = true;
    /// Returns true if a single-body mechanism, given by its body's id, falls freely. Empty: none
    /// does.
    std::function<bool(PartId)> falls;
  };

  /// Called after each tick. Replans if due, advances every hand-over as far as possible, and
  /// returns the grants for everyone in sending order.
  std::vector<Grants> Update(std::int64_t now_us, const PlannerInputs& situation);
  /// Exact states of the mechanisms that the last Update took from the server, for the new
  /// authority. Send these before the grants.
  struct Given {
    int peer = 0;
    ExactStates exact;
  };
  std::vector<Given> TakeGiven() { return std::exchange(given_, {}); }
  /// Returns the peers that were asked kReleasePatienceUs ago to release a mechanism and have not
  /// answered. The caller drops them and calls TakeBack once their lease must have ended. Nothing
  /// of theirs may be taken back earlier: the question may have been lost, and they hold everything
  /// in good faith.
  PeerSet OverdueHolders(std::int64_t now_us) const;
  /// Makes the next Update replan. Called when a client comes or goes.
  void PlanSoon() { plan_due_ = true; }
  /// Returns authority over everything a departed peer had to the server. States of that peer's
  /// epochs no longer count.
  std::vector<Grants> TakeBack(std::int64_t now_us, int peer);
  /// Saves the memory of earlier plans: since when each mechanism has had its authority, and its
  /// hand-over. Reading: the caller then takes back the mechanisms of absent peers.
  void Persist(StateArchive& a);

  /// Returns the whole table for a joining client. A mechanism being revoked is listed without an
  /// authority, as other peers were told.
  std::vector<Grants> Export(std::int64_t now_us) const;
  /// True if the peer has authority over the mechanism according to the grants sent so far.
  bool Has(int peer, int mechanism) const { return table().at(mechanism).authority == peer; }
  /// True if the peer may report a load on anchored parts: only its own world feels the impacts of
  /// what it has.
  bool FeelsAnchored(int peer) const;
  /// Returns the authority that the last plan gives a mechanism, or the current one if there is no
  /// plan yet.
  int Wanted(int mechanism) const;
  /// True if all mechanisms have the same authority and none is being handed over.
  bool InOneHand(const std::vector<int>& mechanisms) const;

  enum class Right {
    kYes,
    kStale,  ///< the epoch is over
    kNo,
  };
  /// Decides if a peer may report a body's state in an epoch: yes if it has held the
  /// mechanism without a break from that epoch until now.
  Right RightToMove(int peer, int body, std::int32_t epoch) const;
  /// Handles a peer's answer that it has released a mechanism (by id), as the grant of that epoch
  /// asked. Accepted only from the holder and for exactly that grant; the next Update acts on it.
  /// An answer to a withdrawn grant has no effect.
  Right AcceptRelease(int peer, PartId mechanism, std::int32_t epoch);
  /// True if a peer that reports an unasked release (its lease has ended) holds the mechanism in
  /// that epoch. The caller then calls TakeBack.
  bool HoldsInEpoch(int peer, PartId mechanism, std::int32_t epoch) const;
  /// Decides if a peer may report the state in which it released a body, as the grant of that epoch
  /// asked.
  Right RightToRelease(int peer, int body, std::int32_t epoch) const;
  /// Records the error of the server's copy of a body that is being handed over. If it is above
  /// kJump or kJumpVelocity, the server keeps the mechanism for kConvergeS before the successor
  /// gets it.
  void NoteCopyError(int body, const BodyState& off);
  /// True if NoteTold has an effect; see AuthorityView::settles.
  bool WatchesAgreement() const { return view_.settles; }
  /// Records the error of the server's copy of a body against its holder's state of the same tick.
  void NoteTold(int body, const BodyState& off);
  /// Adds the peers that need the state in which the holder of the body's mechanism released it.
  void AddAwaiting(int body, PeerSet* peers) const;

  /// Corrections above these, m and m/s, are visible as a jump. Copies converge to a correction
  /// within kConvergeS, s; longer delays hand-overs, by half a second at most.
  static constexpr float kJump = 0.05f, kJumpVelocity = 0.2f;
  static constexpr double kConvergeS = 0.25;
  /// Sets records of the server's own table, as a log has them.
  void Assume(const Grants& own);
  /// Returns the mechanisms with another record in the server's own table since the last call.
  std::vector<int> TakeSet() { return std::exchange(set_, {}); }

 private:
  /// Stage of a hand-over. The table names the old holder until the end.
  enum class HandOver {
    kNone,
    kRevoking,   // the holder was asked to release it
    kReleased,   // the holder has answered
    kOvertaken,  // an edit replaced the mechanism meanwhile: its holder gets a new grant
  };
  /// State of a mechanism besides its record in the table.
  struct Memory {
    HandOver hand_over = HandOver::kNone;
    std::int64_t asked_us = 0;  // when the holder was asked to release it
    std::int64_t told_us = -1;  // when that was sent; -1: it waits for its turn
    PartId revoked_id = 0;                 // the mechanism's id at that time
    std::int64_t unanswered_us = -1;       // as told_us, of the first question not answered yet
    bool withdrawn = false;                // the question was withdrawn; the next one stands
    std::int64_t ask_us = 0;               // after a withdrawal: not asked again earlier
    std::int32_t held_from = -1;           // first epoch of uninterrupted holding; -1: current one
    std::int64_t keep_until_tick = 0;      // the server's until copies have converged
    int last_authority = 0;                // at the last plan
    std::int64_t changed_tick = -1000000;  // tick of the first plan with that authority
    std::int64_t fell_tick = -1000000;     // tick of the last plan that saw it in free fall
    bool open = false;                     // listed in open_
    float contested = 0;                   // see MechanismView
  };

  const AuthorityTable& table() const { return replica_.authority(); }
  /// Returns the state of a mechanism made of these.
  Memory Merged(int m, const std::vector<const Memory*>& before) const;
  AuthorityPlan PlanAfter(const BodyRemap& change) const;
  /// Fills in the planner's input (authority_view.cpp).
  void Look(const PlannerInputs& situation);
  void LookAtPlayers(const PlannerInputs& situation, AuthorityView* view) const;
  void LookAtMechanisms(const PlannerInputs& situation, AuthorityView* view);
  void LookAtMechanism(int m, const PlannerInputs& situation, AuthorityView* view);
  void LookAtBoxes(AuthorityView* view) const;
  /// True if the view may leave out mechanisms asleep far from all else.
  bool MayLeaveOut(const AuthorityView& view);
  /// Choose the mechanisms of the view (authority_sleeping.cpp).
  void SeeAll();
  bool SeesAll() const { return static_cast<int>(seen_.size()) == memory_.size(); }
  void SeeAwakeAndNear(const AuthorityView& view);
  bool MayBeIndexed(int m) const;
  void FindDisturbed();
  bool Lies(int m);
  void IndexSleeping(int m);
  /// Returns a mechanism's index in the view; -1: left out.
  int PlaceOf(int m) const;
  template <class Visit>
  void EachBody(int m, const Visit& visit) const;
  void LookAtCapacity(std::int64_t now_us, const PlannerInputs& situation, AuthorityView* view);
  void Plan(std::int64_t now_us, const PlannerInputs& situation);
  /// Returns by mechanism: 1 if it sleeps at the server and a plan will give it to a player before
  /// anything touches it. Other peers' bodies near it then need not be in the Box2D world on its
  /// account.
  std::vector<char> MayBeDormant(const AuthorityView& view) const;
  /// Returns peers that may lack authority over bodies they are about to touch.
  PeerSet UncertainPeers(const AuthorityView& view) const;
  std::vector<Grants> TakeBack(std::int64_t now_us, const std::vector<int>& mechanisms);
  /// Looks whether the question has been sent.
  void NoteTold(std::int64_t now_us, int m);
  /// True if the holder was sent the question long ago and has not answered.
  bool IsOverdue(std::int64_t now_us, int m) const;
  /// Withdraws an unanswered question: the holder keeps the mechanism in a new epoch.
  void Withdraw(int m);
  void ForgetQuestions(int m);
  std::int64_t PatienceUs(int m) const;
  /// Advances the hand-over of a mechanism as far as possible. Returns false if nothing is left to
  /// do before the next plan.
  bool Advance(std::int64_t now_us, int m);
  /// Lists the mechanism for the next Update.
  void Open(int m);
  /// Returns the record for the time without a holder: the server is next, in a new epoch.
  AuthorityRecord WithoutHolder(AuthorityRecord record) const;

  const Scene& scene_;
  const SyncConfig config_;
  void SetRecord(int m, const AuthorityRecord& record) {
    replica_.authority().Set(m, record);
    set_.push_back(m);
  }

  Replica& replica_;
  std::vector<int> set_;
  const bool physics_edits_;
  const bool islands_;
  AuthorityPlan plan_;     // rebuilt by Plan and by PlanAfter, by mechanism
  AuthorityView view_;     // input of the last plan; kept to reuse its memory
  std::vector<int> seen_;  // mechanisms in view_, ascending
  bool limited_ = false;   // the last plan had a player of limited capacity
  int see_all_ = 0;        // plans left that view all, as most of it is awake
  SleepingIndex sleeping_index_;
  struct Lay {
    std::uint64_t still = 0;  // World::still
    Vec2 position{0, 0};
    float angle = 0;
  };
  BodyColumn<Lay> at_rest_;         // of sleeping mechanisms
  MechanismColumn<char> doubtful_;  // a sleeping one may have been woken
  std::vector<int> stirred_;      // scratch of FindDisturbed: bodies
  std::uint64_t index_change_ = 0;  // World::last_change at the last FindDisturbed
  CapacityWatch capacity_;
  std::vector<int> restricted_;  // parts that not every player may push
  bool sort_open_ = false;
  std::vector<int> open_;       // mechanisms with pending hand-over work, ascending
  std::vector<int> changed_;    // in this Update
  std::vector<Grants> grants_;  // from this Update
  bool taken_over_ = false;     // in this Update
  std::vector<Given> given_;
  PeerSet silent_, untrusted_;               // in the last Update
  std::vector<std::int64_t> round_trip_us_, sent_us_;  // by peer, in the last Update
  bool plan_due_ = true;
  /// The server has simulated every body since the room began. A copy that began later lacks the
  /// memory of stages, such as a character's step: its differences prove nothing.
  bool follows_all_ = true;
  MechanismColumn<Memory> memory_;
  EditHook edited_;
};

}  // namespace seam
