#pragma once
/// Sends the room's messages: publishes each on the bus with a sequence number and forwards it to
/// the sessions that need it.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/sync/publisher.h"
#include "common/sync/replica.h"
#include "server/authority/authority_manager.h"
#include "server/interest/grant_audience.h"
#include "server/interest/interest.h"
#include "server/interest/newest_states.h"
#include "server/interest/rest_audience.h"
#include "server/sessions/session_table.h"
#include "server/sessions/settled_worlds.h"

namespace seam {

class Broadcast {
 public:
  /// All must outlive this object.
  Broadcast(Recorder& recorder, const Room& room, bool views, const SyncConfig& config,
            const Scene& scene, const Replica& replica, SessionTable& sessions)
      : publisher_(recorder, room.room, room.session),
        views_(views),
        config_(config),
        replica_(replica),
        sessions_(sessions),
        looked_at_(replica.table().renumbered()),
        newest_(replica.world(), replica.table(), config.tick_hz),
        interest_(scene, config_, replica),
        grant_audience_(replica, interest_),
        rest_audience_(replica),
        settled_worlds_(replica, sessions),
        followers_(replica.table(), AddFollowers),
        unsettled_until_(replica.table(), MechanismRule::kFresh) {}

  /// True if views are published and something listens to the bus.
  bool ShowsViews() const { return views_ && publisher_.listening(); }
  /// True if, by its latest state, only gravity moves the body of an assembly.
  bool Falls(PartId id) const {
    return newest_.has(id) && (newest_.at(id).flags & kStateFalls) != 0;
  }
  /// Publishes on the bus only.
  template <class Message>
  void Publish(const Message& message) {
    if (publisher_.listening() && !muted_) publisher_.Publish(message);
  }
  /// Publishes on the bus a message that the log has already.
  template <class Message>
  void Repeat(const Message& message) {
    if (publisher_.listening() && !muted_) publisher_.Repeat(message);
  }
  /// Publishes what the server has taken from a client, or into its own table (peer 0).
  template <class Message>
  void NoteAccepted(std::int64_t now_us, int peer, int player, const Message& message) {
    if (!publisher_.listening() || muted_) return;
    Accepted accepted;
    accepted.utime = now_us;
    accepted.peer = peer;
    accepted.player = player;
    accepted.data = Encode(message);
    publisher_.Publish(accepted);
  }
  void PublishUnmoved() { publisher_.PublishUnmoved(); }
  /// While muted publishes nothing: a log has it already.
  void Mute(bool muted) { muted_ = muted; }
  bool muted() const { return muted_; }
  /// Publishes the checksum of a tick, and of what was published before tick 0. The log has all of
  /// it then, before the tick's datagrams leave.
  void EndTick(std::int64_t now_us, bool stepped, bool last = false) {
    if (!publisher_.listening() || (!stepped && !last && !publisher_.pending())) return;
    publisher_.EndTick(now_us, 0, std::max<std::int64_t>(0, replica_.tick()), last);
  }
  /// Notes in the log's checksums where a step begins, and where its tick ends.
  void NoteStep() { publisher_.NoteStep(); }
  void NoteTick() {
    if (publisher_.listening()) publisher_.NoteTick(replica_.world().Hash());
  }
  /// Publishes on the bus and sends reliably to every session that was sent the room.
  template <class Message>
  void ToAll(const Message& message) {
    Publish(message);
    sessions_.SendToAll(Encode(message));
  }
  /// Sends changes of authority: on the bus, and at once to the clients that need them now; to the
  /// rest later (GrantAudience). In a small room everyone gets all changes at once.
  void Tell(const std::vector<Grants>& changes);
  /// Sends pending changes of authority that are due by now. To be called every tick.
  void SendPendingGrants(std::int64_t now_us);
  /// To be called when a peer becomes ready. LookAround is due then.
  void NotePeerReady(int peer) {
    peer_became_ready_ = true;
    if (config_.policy->SendsCompleteTicks()) settled_worlds_.NoteReady(peer);
  }
  /// Copies of the mechanism, a peer's or (0) the server's, differ from its authority's states.
  void NoteDiffering(int peer, int mechanism);
  /// Sends clients the world as it has settled since. To be called every tick.
  void SendSettledWorlds(std::int64_t now_us) { settled_worlds_.Send(now_us); }
  /// To be called when a peer was sent the whole authority table and everything at rest.
  void NoteTold(int peer) {
    grant_audience_.NoteTold(peer);
    rest_audience_.NoteTold(peer);
  }
  /// Sends a rest commit reliably: at once to clients to which the bodies are at least kFar; to the
  /// rest in turn (RefreshDistant), or when the bodies come into interest.
  void TellRest(const Rest& rest, int from_peer);
  /// True if a rest commit in the block is pending for the peer.
  bool RestIsPendingFor(int peer, const RestBlock& at) const {
    return rest_audience_.IsPendingFor(peer, at);
  }
  /// Relays every state of a mechanism to all that simulate it, for kSettleS.
  void NoteUnsettled(int mechanism) {
    unsettled_until_[mechanism] = replica_.tick() + kSettleS * config_.tick_hz;
  }
  void NoteAllUnsettled() {
    for (int m = 0; m < unsettled_until_.size(); ++m) NoteUnsettled(m);
  }
  /// Forwards states to the other peers: to each all states of bodies that it follows, and of the
  /// rest the states that it needs (NewestStates). States not sent at once are queued for
  /// SendWaiting. Does not publish on the bus.
  void Relay(std::int64_t now_us, const States& states, int from_peer);
  /// Sends queued states, as far as the receivers' budgets go. To be called before a flush. States
  /// of displayed bodies wait until the room has stepped, or go along with those of followed ones:
  /// states come from each client at another time, and a datagram for each would be mostly headers.
  void SendWaiting(std::int64_t now_us, bool stepped);
  /// Recomputes relevance, and sends to each client the mechanisms that became more relevant to it.
  void LookAround(std::int64_t now_us);
  /// Sends each client a few mechanisms outside its interest area; clients take turns by tick. To
  /// be called every tick.
  void RefreshDistant(std::int64_t now_us);
  int ticks_per_look() const { return std::max(1, config_.tick_hz / kInterestHz); }
  /// True if there was no LookAround since an edit changed bodies: it is due then.
  bool stale() const { return looked_at_ != replica_.table().renumbered(); }
  /// True if a peer needs the inputs that move a mechanism: it may simulate or predict it.
  bool Simulates(int peer, int mechanism) const;
  /// Calls `visit(Session&)` for each ready client that simulates the mechanism, maybe more than
  /// once.
  template <class Visit>
  void EachSimulating(int mechanism, const Visit& visit) const {
    const bool central = simulators_ == Policy::Simulators::kNear;
    if (simulators_ == Policy::Simulators::kEveryone || (central && interest_.small())) {
      return sessions_.ForEachReady(0, visit);
    }
    const auto visit_peer = [&](int peer) {
      Session* const session = sessions_.Find(peer);
      if (session != nullptr && session->stage == SessionStage::kReady) visit(*session);
    };
    if (central) {
      if (interest_.unknown()) return;
      for (const int peer : interest_.ReceiversFar(mechanism)) {
        if (Simulates(peer, mechanism)) visit_peer(peer);
      }
      return;
    }
    const AuthorityRecord& record = replica_.authority().at(mechanism);
    visit_peer(record.authority);
    record.secondaries.Each(visit_peer);
  }
  /// Calls of LookAround a second.
  static constexpr int kInterestHz = 10;
  /// Mechanisms out of interest that a receiver is sent per second, in turn, each at most every
  /// kDistantEveryUs: so the cost does not grow with the room. Some 20 bytes for each. With 40 a
  /// second, and each every 10 s, the error of all displayed bodies doubles in a room of 9 players,
  /// for 2 kB/s less in one of 32.
  static constexpr int kDistantPerSecond = 240;
  static constexpr std::int64_t kDistantEveryUs = 1000000;

  /// Returns the relevance of a mechanism to a peer.
  Relevance RelevanceOf(int peer, int mechanism) const { return interest_.Of(peer, mechanism); }

 private:
  /// An entry of a States message, and the receivers that need it.
  struct Entry {
    PartId id = 0;
    int mechanism = 0;
    News news = News::kNobody;
    bool to_followers = true;
    bool refresh = true;  ///< due also to those that come to the same state by themselves
  };
  void Send(std::int64_t now_us, Session& session, std::vector<Grants> messages);
  void RequeueLost(std::int64_t now_us, Session& session);
  /// Marks a session for the next SendWaiting: it has states that do not wait for the next step.
  void MarkForSending(const Session& session);
  void SendWaitingTo(std::int64_t now_us, Session& session, bool stepped);
  void NoteFollowers(const std::vector<Grants>& changes);
  /// Lists followers of a mechanism after an edit: of all that it came from.
  static void AddFollowers(const std::vector<int>& before, std::vector<int>* into);
  void FindFollowers();
  void RefreshDistant(std::int64_t now_us, Session& session);
  void AddNewest(std::int64_t now_us, Session& session, int mechanism, Urgency urgency);
  PeerSet HearingRest(int mechanism) const;
  /// Sends the pending rest commits of these mechanisms to a session.
  void SendPendingRest(std::int64_t now_us, Session& session, const std::vector<int>& mechanisms);
  void SendRestToFollowers(std::int64_t now_us, const std::vector<Grants>& changes);
  /// Entries of a message that are due to one peer.
  using Due = std::vector<std::pair<PartId, Urgency>>;
  /// Returns the urgency of an entry for a peer; nullopt: not due to it.
  std::optional<Urgency> DueTo(int peer, const Entry& entry) const;
  void AddDue(int peer, const Entry& entry, Urgency urgency);
  /// Fills due_ from entries_, for all peers but one.
  void FindDue(int but_peer);
  void FindDueOfAny(int but_peer);
  void FindDueByRelevance(int but_peer);
  void RelayDue(std::int64_t now_us, const States& states, const Due& due, Session& session);
  /// True if the body's followers, too, are sent the server's states of it in the name of its
  /// silent holder.
  bool SendsToFollowers(std::int64_t now_us, int holder, int body);
  /// True if the peer simulates or predicts the mechanism, and does not only display it.
  bool Predicts(int peer, int mechanism) const;
  bool Unsettled(int mechanism) const { return replica_.tick() < unsettled_until_[mechanism]; }
  /// True if every client is sent everything: the mode does not use relevance.
  bool Plain() const { return !config_.policy->SelectsTraffic(); }

  Publisher publisher_;
  bool muted_ = false;
  const bool views_;  // views of bodies are published
  const SyncConfig config_;
  const Policy::Simulators simulators_ = config_.policy->simulators();
  const Replica& replica_;
  SessionTable& sessions_;
  std::int64_t looked_at_;  // BodyTable::renumbered at the last LookAround
  NewestStates newest_;
  Interest interest_;
  GrantAudience grant_audience_;
  RestAudience rest_audience_;
  SettledWorlds settled_worlds_;
  std::vector<Entry> entries_;               // in Relay: entries of the message
  std::vector<Due> due_;                     // in Relay, by peer; else empty
  std::vector<int> hearing_;                 // in Relay: peers with a non-empty due_
  bool peer_became_ready_ = true;            // a peer became ready: followers_ is out of date
  MechanismColumn<std::vector<int>> followers_;    // peers, in large rooms only
  MechanismColumn<std::int64_t> unsettled_until_;  // tick
  std::vector<int> pressing_;                // peers marked by MarkForSending
  std::vector<char> presses_;                // by peer: is in pressing_
};

}  // namespace seam
