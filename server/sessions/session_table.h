#pragma once
/// Who is in the room: joining, names and peer numbers, silence, and going. It holds the sessions
/// and says what happened to them; what follows from it is the server's business.

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/codec/codec.h"
#include "common/net/net.h"
#include "common/scene/scene.h"
#include "server/sessions/session.h"

namespace seam {

/// Something that happened to a session.
struct SessionEvent {
  enum class Kind {
    kJoined,  ///< admitted and welcomed
    kProven,  ///< really listens at its address; the room was sent, the world should follow
    kReady,   ///< has loaded the room: simulates, and is told everything
    kLeft,    ///< the session is no more
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
  /// `scene` and `net` must outlive it. `room`: the encoded Room that joiners get.
  SessionTable(const Scene& scene, Bytes room, Net& net);

  enum class Verdict { kTaken, kMalformed, kNoRight };
  using Deliver = std::function<void(Session&, ByteView)>;
  /// Takes a datagram; calls `deliver` for each message of a session. A datagram from an address
  /// without a session is only looked at for a Hello.
  Verdict Receive(std::int64_t now_us, const Address& from, const Bytes& datagram,
                  const Deliver& deliver);
  /// A session said Hello again: loaded, and its clock has settled. Before that it only repeats
  /// itself, and nothing happens.
  void NoteHello(Session& session);
  /// Drops who is silent (lease.h), who never gets ready, and who is leaving.
  void DropSilent(std::int64_t now_us);
  /// Sends the room to those whose address has been proved.
  void Advance(std::int64_t now_us);
  /// What happened since the last call, in order. To be called after each of the above.
  std::vector<SessionEvent> TakeEvents() { return std::exchange(events_, {}); }

  int count() const { return static_cast<int>(sessions_.size()); }
  /// nullptr: no session of this address.
  Session* Find(const Address& address);
  /// By player: the peer that is ready to drive it, or -1.
  std::vector<int> PeerOfPlayer() const;
  int player_count() const;  ///< players who are ready
  std::int64_t WorstRttUs() const;  ///< -1: unknown
  std::int64_t WorstLossPpm() const;

  /// Reliably, to everyone who has proved its address; who never acknowledges has to leave.
  void SendToAll(const Bytes& message);
  /// Calls `visit(Session&)` for all that are ready but one peer.
  template <class Visit>
  void ForEachReady(int but_peer, Visit visit) {
    for (auto& [address, session] : sessions_) {
      if (session->peer == but_peer || session->stage != SessionStage::kReady) continue;
      visit(*session);
    }
  }
  /// Hands everything to the network; counts it in `stats`.
  void Flush(std::int64_t now_us, Stats* stats);
  /// Says goodbye to all, and forgets them without events.
  void Close(std::int64_t now_us, const std::string& reason, Stats* stats);

 private:
  using Sessions = std::map<Address, std::unique_ptr<Session>>;

  Verdict OnStranger(std::int64_t now_us, const Address& from, std::uint64_t number,
                     const Bytes& datagram);
  void Admit(std::int64_t now_us, Session& session, const std::string& name);
  /// A free peer number for one who plays `player` (-1: nobody); -1: the room is full.
  int ChoosePeer(int player) const;
  void Refuse(std::int64_t now_us, const Session& session, const std::string& reason);
  /// Makes room by dropping the oldest session that has not proved its address; false if none.
  bool EvictUnproven(std::int64_t now_us);
  void Drop(const Address& address, const std::string& why);
  void Note(SessionEvent::Kind kind, const Session& session, const std::string& why = "");

  const Scene& scene_;
  const Bytes room_;
  Net& net_;
  Sessions sessions_;
  std::vector<SessionEvent> events_;
};

}  // namespace seam
