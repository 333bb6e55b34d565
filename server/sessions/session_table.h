#pragma once
/// Who is in the room: joining, names and peer numbers, silence, and going. It holds the sessions
/// and says what happened to them; what follows from it is the server's business.

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/base/entropy.h"
#include "common/codec/codec.h"
#include "common/net/net.h"
#include "common/scene/scene.h"
#include "server/sessions/account_book.h"
#include "server/sessions/handshake.h"
#include "server/sessions/place_table.h"
#include "server/sessions/session.h"

namespace seam {

/// Something that happened to a session.
struct SessionEvent {
  enum class Kind {
    kJoined,   ///< admitted and welcomed
    kLoading,  ///< the room was sent, the world should follow
    kReady,    ///< has loaded the room: simulates, and is told everything
    kLeft,     ///< the session is no more
  };
  Kind kind = Kind::kJoined;
  Address address;
  std::string name;
  int peer = 0;
  int player = -1;
  bool was_ready = false;  ///< kLeft: had been ready before
  std::string why;         ///< kLeft
};

class SessionTable {
 public:
  /// `scene`, `net` and `entropy` must outlive it. `room`: the encoded Room that joiners get;
  /// `allowed`: what each of them may send; `bytes_per_s`: what each is sent at most, 0: no limit.
  SessionTable(const Scene& scene, Bytes room, const TrafficRate& allowed, Net& net,
               Entropy& entropy, double bytes_per_s = 0);

  enum class Verdict { kTaken, kMalformed, kNoRight, kOverBudget };
  using Deliver = std::function<void(Session&, ByteView)>;
  /// Takes a datagram; calls `deliver` for each message of a session. What belongs to no session
  /// is only looked at for a Hello or a Join.
  Verdict Receive(std::int64_t now_us, const Address& from, const Bytes& datagram,
                  const Deliver& deliver);
  /// A session said Ready. Before the room was sent that means nothing.
  void NoteReady(Session& session);
  /// Drops who is silent (lease.h), who never gets ready, who sends too much, and who is leaving.
  void DropSilent(std::int64_t now_us);
  /// It has to leave: the next DropSilent drops it. The first reason counts.
  void Leave(Session& session, const std::string& why);
  /// Sends the room to those who have been admitted since.
  void Advance(std::int64_t now_us);
  /// What happened since the last call, in order. To be called after each of the above.
  std::vector<SessionEvent> TakeEvents() { return std::exchange(events_, {}); }

  int count() const { return static_cast<int>(sessions_.size()); }
  /// nullptr: no session of this peer.
  Session* Find(int peer);
  /// By player: the peer that is ready to drive it, or -1.
  const std::vector<int>& PeerOfPlayer() const { return peer_of_player_; }
  int player_count() const;         ///< players who are ready
  std::int64_t WorstRttUs() const;  ///< -1: unknown
  std::int64_t WorstLossPpm() const;
  /// "free are bob, carl": the scene's players that may join now, as many as fit a message.
  std::string FreeNames(std::int64_t now_us) const { return places_.FreeNames(now_us); }
  /// Reads round trip and loss of all that are ready into their accounts. Once a second.
  void ReadAccounts();
  /// Of all who were in the room.
  const AccountBook& accounts() const { return accounts_; }

  /// Reliably, to everyone to whom the room was sent; who never acknowledges has to leave. Not to
  /// peer `but_peer`.
  void SendToAll(const Bytes& message, int but_peer = -1);
  /// The same to one of them.
  void SendTo(Session& session, const Bytes& message);
  /// The same for what they wait for (Link::SendUrgent).
  void SendUrgentToAll(const Bytes& message);
  void SendUrgentTo(Session& session, const Bytes& message);
  /// Calls `visit(Session&)` for everyone to whom the room was sent.
  template <class Visit>
  void ForEachTold(Visit visit) {
    for (Session* session : in_order_) {
      if (session->stage != SessionStage::kAdmitted) visit(*session);
    }
  }
  /// Calls `visit(Session&)` for all that are ready but one peer.
  template <class Visit>
  void ForEachReady(int but_peer, Visit visit) {
    for (Session* session : in_order_) {
      if (session->peer == but_peer || session->stage != SessionStage::kReady) continue;
      visit(*session);
    }
  }
  /// Hands everything to the network; counts it in `stats`.
  void Flush(std::int64_t now_us, Stats* stats);
  /// Says goodbye to all, and forgets them without events.
  void Close(std::int64_t now_us, const std::string& reason, Stats* stats);

 private:
  using Sessions = std::map<SessionId, std::unique_ptr<Session>>;

  void LeaveUnless(bool sent, Session& session);
  /// Who is there, or ready, has changed.
  void NoteChanged();
  Verdict OnStranger(std::int64_t now_us, const SessionId& id, const Bytes& datagram);
  void Admit(std::int64_t now_us, const SessionId& id, int peer);
  Verdict OnSession(std::int64_t now_us, Session& session, const Bytes& datagram,
                    const Deliver& deliver);
  std::string TooLong(std::int64_t now_us, const Session& session);
  void Drop(const SessionId& id, const std::string& why);
  void Note(SessionEvent::Kind kind, const Session& session, const std::string& why = "");

  const Scene& scene_;
  const Bytes room_;
  const TrafficRate allowed_;
  const double bytes_per_s_;
  Net& net_;
  Handshake handshake_;
  PlaceTable places_;
  AccountBook accounts_;
  Sessions sessions_;
  // Looked at with every datagram: the map is not for that.
  std::vector<Session*> in_order_;  // of sessions_
  std::vector<Session*> by_peer_;
  std::vector<int> peer_of_player_;
  std::vector<SessionEvent> events_;
  bool admitted_ = false;       // somebody was, since the last Advance
  bool leaving_ = false;        // somebody is
  std::int64_t silent_us_ = 0;  // before that nobody has been silent for too long
};

}  // namespace seam
