#pragma once
/// What everyone is told: numbered on the bus, and to the sessions that it concerns.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/sync/publisher.h"
#include "common/sync/replica.h"
#include "server/authority/authority_manager.h"
#include "server/interest/grant_news.h"
#include "server/interest/interest.h"
#include "server/interest/newest_states.h"
#include "server/interest/rest_news.h"
#include "server/sessions/session_table.h"

namespace seam {

class Broadcast {
 public:
  /// All must outlive it.
  Broadcast(Recorder& recorder, const std::string& room, bool views, const SyncConfig& config,
            const Scene& scene, const Replica& replica, SessionTable& sessions)
      : publisher_(recorder, room),
        views_(views),
        config_(config),
        replica_(replica),
        sessions_(sessions),
        newest_(replica.world(), config.tick_hz),
        interest_(scene, config_, replica),
        grant_news_(replica, interest_),
        rest_news_(replica) {}

  /// Whether anybody can see what this server shows of bodies.
  bool ShowsViews() const { return views_ && publisher_.listening(); }
  /// Whether nothing but gravity moves the body of an assembly, as was last heard of it.
  bool Falls(PartId id) const {
    return newest_.has(id) && (newest_.at(id).flags & kStateFalls) != 0;
  }
  /// On the bus only.
  template <class Message>
  void Publish(const Message& message) {
    if (publisher_.listening()) publisher_.Publish(message);
  }
  /// On the bus and, reliably, to everyone who has proved its address.
  template <class Message>
  void ToAll(const Message& message) {
    Publish(message);
    sessions_.SendToAll(Encode(message));
  }
  /// Changes of authority: on the bus, and at once to those whom they concern; the others hear of
  /// them later (GrantNews). In a small room all of it goes to everyone at once.
  void Tell(const std::vector<Grants>& changes);
  /// What peers are owed of such changes by now. Every tick.
  void TellOwed(std::int64_t now_us);
  /// A peer is ready: LookAround is due.
  void NoteCome() { come_ = true; }
  /// A peer was told of all authorities.
  void NoteTold(int peer) {
    grant_news_.NoteTold(peer);
    rest_news_.NoteTold(peer);
  }
  /// Bodies have come to rest: at once to those to whom they are at least far, reliably; to the
  /// others as their turn comes (TellNothings), or when they come to concern them.
  void TellRest(const Rest& rest, int from_peer);
  /// Whether a peer was not told yet of all that rests in a block.
  bool OwesRest(int peer, const RestBlock& at) const { return rest_news_.Owes(peer, at); }
  /// To each of the other peers what concerns it: all of the bodies that it follows, of the others
  /// what is news to it (NewestStates). What is not sent at once waits for SendWaiting. Not on the
  /// bus.
  void Relay(std::int64_t now_us, const States& states, int from_peer);
  /// What waits for the receivers, as far as their budgets go. Before a flush. What is only shown
  /// waits for the call in which the room has stepped, or goes along with what is followed: states
  /// come from each client at another time, and a datagram for each would be mostly headers.
  void SendWaiting(std::int64_t now_us, bool stepped);
  /// Looks anew at what concerns whom, and tells what concerns somebody more than before.
  void LookAround(std::int64_t now_us);
  /// Tells everyone a little of what is nothing to them: to each in another tick. Every tick.
  void TellNothings(std::int64_t now_us);
  int ticks_per_look() const { return std::max(1, config_.tick_hz / kLooksPerSecond); }
  /// The bodies have changed; LookAround is due.
  void Remap(const BodyRemap& change);
  bool stale() const { return stale_; }
  /// Whether a peer simulates a mechanism, or predicts it: whose inputs move it concern that peer.
  bool Simulates(int peer, int mechanism) const;
  /// Calls `visit(Session&)` for each ready client that does, maybe more than once.
  template <class Visit>
  void EachSimulating(int mechanism, const Visit& visit) const {
    const bool central = config_.mode == Mode::kCentral;
    if (config_.mode == Mode::kOracle || (central && interest_.small())) {
      return sessions_.ForEachReady(0, visit);
    }
    const auto visit_peer = [&](int peer) {
      Session* const session = sessions_.Find(peer);
      if (session != nullptr && session->stage == SessionStage::kReady) visit(*session);
    };
    if (central) {
      if (interest_.unknown()) return;
      for (const int peer : interest_.Hearing(mechanism)) {
        if (Simulates(peer, mechanism)) visit_peer(peer);
      }
      return;
    }
    const AuthorityRecord& record = replica_.authority().at(mechanism);
    visit_peer(record.authority);
    record.secondaries.Each(visit_peer);
  }
  /// Something a person wants to read; on the bus only.
  void Say(std::int64_t now_us, const std::string& text);

  /// Looks a second.
  static constexpr int kLooksPerSecond = 10;
  /// Mechanisms a second, of all that is nothing to a receiver together, of which it is told where
  /// they are, in turn, each at most every kNothingEveryUs: so what that costs does not grow with
  /// the room. Some 20 bytes for each: with 40, and each every 10 s, the error of all that is shown
  /// doubles in a room of 9 players, for 2 kB/s less in one of 32.
  static constexpr int kNothingPerSecond = 240;
  static constexpr std::int64_t kNothingEveryUs = 1000000;

  /// How much a mechanism concerns a peer.
  Concern ConcernOf(int peer, int mechanism) const { return interest_.Of(peer, mechanism); }

 private:
  /// An entry of a message, and whom it concerns.
  struct Entry {
    PartId id = 0;
    int mechanism = 0;
    News news = News::kNobody;
    bool to_followers = true;
  };
  void Send(std::int64_t now_us, Session& session, std::vector<Grants> messages);
  void TellLostAgain(std::int64_t now_us, Session& session);
  /// Something is for it that does not wait for the next step.
  void NotePressing(const Session& session);
  void SendWaitingTo(std::int64_t now_us, Session& session, bool stepped);
  void NoteFollowers(const std::vector<Grants>& changes);
  void FindFollowers();
  void TellNothings(std::int64_t now_us, Session& session);
  void AddNewest(std::int64_t now_us, Session& session, int mechanism, Urgency urgency);
  bool HearsRest(const Session& session, int mechanism) const;
  /// What a session is owed of the rest of these mechanisms.
  void TellOwedRest(std::int64_t now_us, Session& session, const std::vector<int>& mechanisms);
  void TellRestToFollowers(std::int64_t now_us, const std::vector<Grants>& changes);
  /// Of the entries of a message what is due to a peer.
  using Due = std::vector<std::pair<PartId, Urgency>>;
  /// How urgently an entry is due to a peer, if it is.
  std::optional<Urgency> DueTo(int peer, const Entry& entry) const;
  void AddDue(int peer, const Entry& entry, Urgency urgency);
  /// By peer, what is due of what `entries_` has.
  void FindDue(int but_peer);
  void FindDueOfAny(int but_peer);
  void FindDueByConcern(int but_peer);
  void RelayDue(std::int64_t now_us, const States& states, const Due& due, Session& session);
  /// Whether who simulates it itself is told where it is in its silent holder's name.
  bool TellsFollowers(std::int64_t now_us, int holder, int body);
  /// Whether states go to everyone whole: nobody's mode tells apart what concerns whom.
  bool Plain() const { return config_.mode != Mode::kBuffer && config_.mode != Mode::kCentral; }

  Publisher publisher_;
  const bool views_;  // what it shows of bodies is published
  const SyncConfig config_;
  const Replica& replica_;
  SessionTable& sessions_;
  bool stale_ = false;
  NewestStates newest_;
  Interest interest_;
  GrantNews grant_news_;
  RestNews rest_news_;
  std::vector<Entry> entries_;               // of the message that is relayed
  std::vector<Due> due_;                     // by peer, of it; else empty
  std::vector<int> hearing_;                 // peers to whom anything of it is due
  bool come_ = false;                        // a peer has: whom it follows is not in followers_
  std::vector<std::vector<int>> followers_;  // by mechanism: peers; of a large room
  std::vector<int> pressing_;                // peers for whom something does not wait
  std::vector<char> presses_;                // by peer: is in pressing_
};

}  // namespace seam
