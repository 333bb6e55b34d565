#pragma once
/// Who owns a body: the server's one answer. It holds the state of authority, follows the plan with
/// one holder at a time, and says what is to be told to everyone; it sends nothing itself.

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "common/sync/replica.h"
#include "server/authority/capacity_watch.h"
#include "server/authority/lying.h"
#include "server/authority/plan.h"

namespace seam {

class AuthorityManager {
 public:
  /// Writes the table of `replica`, which, like `scene`, must outlive it. At first the server has
  /// everything; in mode buffer it follows everything too, so that it can take over at any moment.
  AuthorityManager(const Scene& scene, const SyncConfig& config, Replica& replica);

  /// What it cannot know by itself.
  struct Situation {
    std::vector<int> peer_of_player;         ///< -1: nobody is ready to drive it
    std::vector<float> one_way_s;            ///< by player, from the server to it; empty: all 0
    PeerSet silent;                          ///< peers not heard for kSilentUs
    std::vector<std::vector<int>> together;  ///< see AuthorityView
    /// By player: share of its time that its peer needs for its ticks; below 0: not known. Empty:
    /// of nobody.
    std::vector<float> load;
    /// Somebody looks at what the server shows: see Scene::server_follow.
    bool shown = true;
    /// Whether a mechanism of one body falls freely, by the body's id; empty: none.
    std::function<bool(PartId)> falls;
  };

  /// After each tick: plans when that is due, and takes every hand-over as far as it can go.
  /// Returns what everyone is to be told, in this order.
  std::vector<Grants> Update(std::int64_t now_us, const Situation& situation);
  /// Where the bodies were that the last Update took from the server itself, for who gets them:
  /// to be told before the grants.
  struct Given {
    int peer = 0;
    ExactStates exact;
  };
  std::vector<Given> TakeGiven() { return std::exchange(given_, {}); }
  /// Peers that were told to let go of something kReleasePatienceUs ago and have not answered. They
  /// have to leave: TakeBack when their lease must have ended. Not before, of nothing: they may not
  /// have heard the question behind what was lost, and have all that they have in good faith.
  PeerSet Withholding(std::int64_t now_us) const;
  /// Somebody came or went: the next Update plans.
  void PlanSoon() { plan_due_ = true; }
  /// The server has what a peer that is gone had. States of the epochs it had count no more.
  std::vector<Grants> TakeBack(std::int64_t now_us, int peer);
  /// The mechanisms are others now; see BodyRemap.
  void Remap(const std::vector<std::vector<int>>& from);

  /// Everything, for one who joins: what is being revoked is nobody's, as the others were told.
  std::vector<Grants> Export(std::int64_t now_us) const;
  /// Whether the peer has authority over the mechanism, as far as everyone was told.
  bool Has(int peer, int mechanism) const { return table().at(mechanism).authority == peer; }
  /// Whom the last plan gives a mechanism; its authority where nothing is planned yet.
  int Wanted(int mechanism) const;
  /// Whether the peer follows a body in its buffer zone.
  bool Follows(int peer, int body) const;
  /// Whether mechanisms have one authority, and none of them is changing hands.
  bool InOneHand(const std::vector<int>& mechanisms) const;

  enum class Right {
    kYes,
    kStale,  ///< of an epoch that is over
    kNo,
  };
  /// Whether a peer may say, in an epoch, where a body is: in any in which it had it all the time
  /// until now.
  Right RightToMove(int peer, int body, std::int32_t epoch) const;
  /// A peer says that it has let go of a mechanism (by its id), as the grant of that epoch told it.
  /// Believed only of the holder and of exactly that grant; the next Update acts on it. Of a grant
  /// that was withdrawn meanwhile it means nothing.
  Right NoteRelease(int peer, PartId mechanism, std::int32_t epoch);
  /// Whether a peer says of a mechanism, in the epoch in which it has it, that it has let go of it
  /// although nobody asked: its lease has ended. TakeBack follows.
  bool GivesUp(int peer, PartId mechanism, std::int32_t epoch) const;
  /// Whether a peer may say where a body was when it let go, as the grant of that epoch told it.
  Right RightToRelease(int peer, int body, std::int32_t epoch) const;
  /// The server's copy of a body that changes hands was off by this much. If that is a lot, the
  /// server keeps its mechanism for kConvergeS before the successor gets it.
  void NoteJump(int body, const BodyState& off);
  /// Whether NoteTold is of use; see AuthorityView::exact.
  bool WatchesAgreement() const { return view_.exact; }
  /// How far the server's copy of a body was from what its holder tells of a tick.
  void NoteTold(int body, const BodyState& off);
  /// Whether the peer needs to hear where a mechanism's holder let go of it.
  bool Awaits(int peer, int body) const;

  /// Differences above these are shown as a jump, m and m/s. Copies glide to what they were
  /// corrected to within kConvergeS, s; longer delays hand-overs, at most by half a second.
  static constexpr float kJump = 0.05f, kJumpVelocity = 0.2f;
  static constexpr double kConvergeS = 0.25;

 private:
  /// How far a mechanism is on its way from its holder, whom the table names until the end.
  enum class HandOver {
    kNone,
    kRevoking,   // the holder is told to let go
    kReleased,   // and has answered
    kOvertaken,  // an edit made another mechanism of it meanwhile: its holder gets it anew
  };
  /// What is remembered of a mechanism besides its record.
  struct Memory {
    HandOver hand_over = HandOver::kNone;
    std::int64_t revoked_us = 0;           // when the holder was told to let go
    PartId revoked_id = 0;                 // of what
    std::int64_t unanswered_us = 0;        // when it was told so first, without an answer yet
    bool withdrawn = false;                // since then: the next question stands
    std::int64_t ask_us = 0;               // after that it is not asked before this
    std::int32_t held_from = -1;           // epoch since which it has it all the time; -1: the last
    std::int64_t keep_until_tick = 0;      // the server's, until its copies have converged
    int last_authority = 0;                // when it was planned last
    std::int64_t changed_tick = -1000000;  // when a plan first saw that authority
    std::int64_t fell_tick = -1000000;     // when a plan last saw that it falls freely
    bool open = false;                     // is in open_
    float contested = 0;                   // see MechanismView
  };

  const AuthorityTable& table() const { return replica_.authority(); }
  /// Fills in what planning sees (authority_view.cpp).
  void Look(const Situation& situation);
  void LookAtPlayers(const Situation& situation, AuthorityView* view) const;
  void LookAtMechanisms(const Situation& situation, AuthorityView* view);
  void LookAtMechanism(int m, const Situation& situation, AuthorityView* view);
  void LookAtBoxes(AuthorityView* view) const;
  /// Whether the view may be without what lies far from all else.
  bool LeavesOut(const AuthorityView& view);
  /// Chooses what the view is of (authority_lying.cpp).
  void SeeAll();
  void SeeWithoutLying(const AuthorityView& view);
  bool MayLie(int m) const;
  void FindDoubtful();
  bool Lies(int m);
  void PutLying(int m);
  /// A mechanism's index in the view; -1: left out.
  int PlaceOf(int m) const;
  template <class Visit>
  void EachBody(int m, const Visit& visit) const;
  void LookAtCapacity(std::int64_t now_us, const Situation& situation, AuthorityView* view);
  void Plan(std::int64_t now_us, const Situation& situation);
  /// By mechanism, as it is planned: 1 where what sleeps here becomes somebody's before anything
  /// touches it, so that nobody else's things have to be here on its account.
  std::vector<char> Unwatched(const AuthorityView& view) const;
  /// Peers that are not given all that they will touch.
  PeerSet Doubtful(const AuthorityView& view) const;
  std::vector<Grants> TakeBack(std::int64_t now_us, const std::vector<int>& mechanisms);
  /// Whether its holder was told to let go of it long ago, and has not answered.
  bool Withheld(std::int64_t now_us, int m) const;
  /// The holder has not answered: it keeps what it was asked to let go of, an epoch on.
  void Withdraw(int m);
  void ForgetQuestions(int m);
  std::int64_t PatienceUs(int m) const;
  /// Takes the hand-over of a mechanism as far as it can go; false: nothing is left to do before
  /// the next plan.
  bool Advance(std::int64_t now_us, int m);
  /// The next Update looks at the mechanism.
  void Open(int m);
  /// The record while nobody has it: the server next, an epoch on.
  AuthorityRecord WithoutHolder(AuthorityRecord record) const;

  const Scene& scene_;
  const SyncConfig config_;
  Replica& replica_;
  const bool physics_edits_;
  const bool islands_;
  AuthorityPlan plan_;     // the last one
  AuthorityView view_;     // what it saw: its memory is used again
  std::vector<int> seen_;  // mechanisms that it is of, ascending
  bool limited_ = false;   // somebody's capacity is, in the last plan
  int see_all_ = 0;        // so many more plans see all: most of it is awake
  Lying lying_;
  struct Lay {
    std::uint64_t still = 0;  // World::still
    Vec2 position{0, 0};
    float angle = 0;
  };
  std::vector<Lay> lay_;          // by body of what lies
  std::vector<char> doubtful_;    // by mechanism that lies: it may lie no more
  std::vector<int> stirred_;      // for FindDoubtful: bodies
  std::uint64_t lay_change_ = 0;  // World::last_change when it was found last what lies
  CapacityWatch capacity_;
  std::vector<int> restricted_;  // parts that not everybody may push
  bool sort_open_ = false;
  std::vector<int> open_;       // mechanisms of which something is to be done, ascending
  std::vector<int> changed_;    // in this Update
  std::vector<Grants> grants_;  // of this Update
  bool taken_over_ = false;     // in this Update
  std::vector<Given> given_;
  PeerSet silent_;                           // in the last Update
  std::vector<std::int64_t> round_trip_us_;  // by peer, in the last Update
  bool plan_due_ = true;
  std::vector<Memory> memory_;  // by mechanism
};

}  // namespace seam
