#pragma once
/// The sessions of the room: joining, names and peer numbers, timeouts, leaving. Reports changes of
/// sessions as events; the server acts on them.

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "common/base/entropy.h"
#include "common/codec/codec.h"
#include "common/net/net.h"
#include "common/record/load_page.h"
#include "common/scene/scene.h"
#include "server/sessions/account_book.h"
#include "server/sessions/handshake.h"
#include "server/sessions/place_table.h"
#include "server/sessions/room_chunks.h"
#include "server/sessions/session.h"

namespace seam {

/// Something that happened to a session.
struct SessionEvent {
  enum class Kind {
    kJoined,   ///< admitted and welcomed
    kLoading,  ///< the Room was sent; the world has to follow
    kReady,    ///< has loaded the room: simulates, and receives all messages
    kLeft,     ///< the session has ended
  };
  Kind kind = Kind::kJoined;
  Address address;
  std::string name;
  int peer = 0;
  int player = -1;
  bool was_ready = false;  ///< kLeft: the session had been ready
  std::string why;         ///< kLeft
};

class SessionTable {
 public:
  /// `scene`, `net` and `entropy` must outlive this object. `room`: the encoded Room for joiners,
  /// who get it compressed;
  /// `allowed`: limit for traffic from each; `bytes_per_s`: limit for traffic to each, 0: none;
  /// `identity`: the server's lasting keys, nullptr: drawn; `door`: whom the room lets in.
  SessionTable(const Scene& scene, const Bytes& room, const TrafficRate& allowed, Net& net,
               Entropy& entropy, double bytes_per_s = 0,
               std::shared_ptr<const KeyPair> identity = nullptr, TokenDoor door = {});

  enum class Verdict { kTaken, kMalformed, kNoRight, kOverBudget };
  using Deliver = std::function<void(Session&, ByteView)>;
  /// Takes a datagram; calls `deliver` for each message of a session. The session is found by its
  /// number; if the datagram opens, its newest so far, the session is at that address from then on.
  /// A datagram without a session is ignored unless it begins with a Hello or a Join.
  Verdict Receive(std::int64_t now_us, const Address& from, const Bytes& datagram,
                  const Deliver& deliver);
  /// Handles a Ready message. Ignored unless the session is loading.
  void NoteReady(Session& session);
  /// Returns the players whose clients have returned (ClientAccount::returned_us) within the last
  /// `within_us`.
  std::vector<int> Returned(std::int64_t now_us, std::int64_t within_us) const;
  /// Drops sessions that are silent (lease.h), never get ready, send too much, or are leaving.
  void DropSilent(std::int64_t now_us);
  /// Marks a session to be dropped by the next DropSilent. The first reason counts.
  void Leave(Session& session, const std::string& why);
  /// Sends the room to admitted sessions, as fast as they acknowledge it.
  void Advance(std::int64_t now_us);
  /// Returns the events since the last call, in order. To be called after each of the above.
  std::vector<SessionEvent> TakeEvents() { return std::exchange(events_, {}); }

  int count() const { return static_cast<int>(sessions_.size()); }
  /// Returns nullptr if this peer has no session.
  Session* Find(int peer);
  /// By player: the peer that is ready to drive it, or -1.
  const std::vector<int>& PeerOfPlayer() const { return peer_of_player_; }
  int player_count() const;         ///< players with a ready client
  std::int64_t WorstRttUs() const;  ///< -1: unknown
  std::int64_t WorstLossPpm() const;
  /// Returns "free are bob, carl": the scene's players that may join now, as many as fit a message.
  std::string FreeNames(std::int64_t now_us) const { return places_.FreeNames(now_us); }
  /// See PlaceTable::IsReserved.
  bool IsReserved(std::int64_t now_us, int player) const {
    return places_.IsReserved(now_us, player);
  }
  PlaceTable& places() { return places_; }
  /// Reads round trip and loss of all ready sessions into their accounts and the room's sums. Once
  /// a second.
  void ReadAccounts(Connections* connections);
  /// Accounts of all clients that were in the room, present or gone.
  AccountBook& accounts() { return accounts_; }
  const AccountBook& accounts() const { return accounts_; }
  /// All bytes of sessions and strangers, by kind.
  const TrafficCount& traffic() const { return traffic_; }
  /// The server's lasting public key.
  const PublicKey& identity() const { return identity_->open; }
  std::shared_ptr<const KeyPair> keys() const { return identity_; }

  /// Sends reliably to every session that was sent the room, except peer `but_peer`. A session that
  /// never acknowledges has to leave.
  void SendToAll(const Bytes& message, int but_peer = -1);
  /// Like SendToAll, to one session.
  void SendTo(Session& session, const Bytes& message);
  /// Like SendToAll and SendTo, by Link::SendUrgent: for messages that the client waits for.
  void SendUrgentToAll(const Bytes& message);
  void SendUrgentTo(Session& session, const Bytes& message);
  /// Calls `visit(Session&)` for every session that was sent the room.
  template <class Visit>
  void ForEachSentRoom(Visit visit) {
    for (Session* session : in_order_) {
      if (session->stage != SessionStage::kAdmitted) visit(*session);
    }
  }
  /// Calls `visit(Session&)` for all ready sessions except peer `but_peer`.
  template <class Visit>
  void ForEachReady(int but_peer, Visit visit) {
    for (Session* session : in_order_) {
      if (session->peer == but_peer || session->stage != SessionStage::kReady) continue;
      visit(*session);
    }
  }
  /// Sends queued messages, to each session as fast as its path and budget allow; counts bytes and
  /// datagrams in `stats`.
  void Flush(std::int64_t now_us, Stats* stats);
  /// Says goodbye to all sessions and ends them without events.
  void Close(std::int64_t now_us, const std::string& reason, Stats* stats);

  /// Tells all sessions, and from now on those that join, to go on at another server.
  void RedirectAll(const Redirect& redirect);
  /// Ends all sessions without a word, and admits nobody any more: the room goes on elsewhere.
  void Forsake();
  /// True if no session is left that has not acknowledged everything.
  bool AllTold() const;
  /// Returns the highest epoch of the room above its own that a client has proved; 0: none.
  std::int32_t shown_epoch() const { return shown_epoch_; }

 private:
  using Sessions = std::map<SessionId, std::unique_ptr<Session>>;

  void FlushTo(std::int64_t now_us, Session& session, std::size_t reliable_bytes, Stats* stats);
  void LeaveUnless(bool sent, Session& session);
  /// Rebuilds the indices after a session came, went or became ready.
  void NoteChanged();
  Verdict OnStranger(std::int64_t now_us, const SessionId& id, const Bytes& datagram);
  /// Returns why a client that has proved its address may not come in, or "".
  std::string NoEntry(const JoinRequest& join) const;
  Session* Admit(std::int64_t now_us, const SessionId& id, const SealKeys& keys,
                 const PlaceTable::Answer& answer);
  Verdict OnSession(std::int64_t now_us, Session& session, const Address& from,
                    const Bytes& datagram, const Deliver& deliver);
  std::string TooLong(std::int64_t now_us, const Session& session);
  void Drop(const SessionId& id, const std::string& why);
  void Note(SessionEvent::Kind kind, const Session& session, const std::string& why = "");
  /// Returns when the session must have said something again, and be ready, us.
  std::int64_t HeardByUs(const Session& session) const;
  std::int64_t ReadyByUs(const Session& session) const;

  const Scene& scene_;
  const RoomChunks room_;
  const TrafficRate allowed_;
  const double bytes_per_s_;
  Net& net_;
  TrafficCount traffic_;
  const std::shared_ptr<const KeyPair> identity_;
  const TokenDoor door_;
  Handshake handshake_;
  std::optional<Redirect> redirect_;  // set: the answer to every join
  bool forsaken_ = false;
  std::int32_t shown_epoch_ = 0;
  const std::int64_t epoch_proof_;
  PlaceTable places_;
  AccountBook accounts_;
  Sessions sessions_;
  // Indices for lookups with every datagram, where the map is too slow.
  std::unordered_map<std::uint64_t, Session*> by_number_;  // by the number of the sealed session
  std::vector<Session*> in_order_;  // in the order of sessions_
  std::vector<Session*> by_peer_;
  std::vector<int> peer_of_player_;
  std::vector<SessionEvent> events_;
  bool admitted_ = false;       // some session was not sent all of the room yet
  bool leaving_ = false;        // some session is
  std::int64_t silent_us_ = 0;  // time of the next check for timeouts
};

}  // namespace seam
