#include "server/sessions/session_table.h"

#include <algorithm>

#include "common/sync/lease.h"

namespace seam {
namespace {

/// A session that never proves its address or never gets ready is forgotten after this, us.
constexpr std::int64_t kHalfOpenUs = 10000000;
/// Time an address has to prove itself when others wait for its place, us: forged hellos must not
/// fill the room.
constexpr std::int64_t kProofUs = 1000000;
/// A goodbye is sent this often, each in a datagram of its own.
constexpr int kByeCopies = 4;
/// A name is free for a new session (a restarted client) when the old one was silent this long, us.
constexpr std::int64_t kNameHeldUs = 1000000;
/// The same for an address.
constexpr std::int64_t kAddressHeldUs = 500000;
/// Sessions that have not proved their address, at most: more are refused until some time out.
constexpr std::size_t kSessionsMax = 64;

}  // namespace

SessionTable::SessionTable(const Scene& scene, Bytes room, Net& net)
    : scene_(scene), room_(std::move(room)), net_(net) {}

SessionTable::Verdict SessionTable::Receive(std::int64_t now_us, const Address& from,
                                            const Bytes& datagram, const Deliver& deliver) {
  const std::uint64_t number = PeekSession(datagram);
  if (number == 0) return Verdict::kMalformed;
  Session* session = Find(from);
  if (session != nullptr && session->number != number) {
    // A restarted client on the same port: its old self is gone, if it has been quiet for a while.
    if (now_us - session->link.last_receive_us() < kAddressHeldUs) return Verdict::kNoRight;
    Drop(from, "came back with a new session");
    session = nullptr;
  }
  if (session == nullptr) return OnStranger(now_us, from, number, datagram);
  const bool good = session->link.Receive(now_us, datagram,
                                          [&](ByteView message) { deliver(*session, message); });
  return good ? Verdict::kTaken : Verdict::kMalformed;
}

/// The one place that decides what an address without a session can cause here.
SessionTable::Verdict SessionTable::OnStranger(std::int64_t now_us, const Address& from,
                                               std::uint64_t number, const Bytes& datagram) {
  if (sessions_.size() >= kSessionsMax && !EvictUnproven(now_us)) return Verdict::kNoRight;
  auto session = std::make_unique<Session>(number);
  session->address = from;
  session->created_us = now_us;
  bool greeted = false;
  const bool good = session->link.Receive(now_us, datagram, [&](ByteView message) {
    const AnyMessage any = Decode(message);
    const Hello* hello = std::get_if<Hello>(&any);
    if (hello == nullptr || greeted) return;
    greeted = true;
    if (hello->protocol == kProtocolVersion) {
      Admit(now_us, *session, hello->name);
    } else {
      Refuse(now_us, *session, "protocol " + std::to_string(kProtocolVersion) + " is spoken here");
    }
  });
  if (!good || !greeted) return Verdict::kMalformed;
  if (session->peer > 0) sessions_.emplace(from, std::move(session));
  return Verdict::kTaken;
}

void SessionTable::Admit(std::int64_t now_us, Session& session, const std::string& name) {
  const auto same = std::find_if(sessions_.begin(), sessions_.end(),
                                 [&](const auto& s) { return s.second->name == name; });
  if (same != sessions_.end()) {
    if (now_us - same->second->link.last_receive_us() < kNameHeldUs) {
      Refuse(now_us, session, "the name " + name + " is in use");
      return;
    }
    const Address old = same->first;
    Drop(old, "replaced by a new session of the same name");
  }
  if (sessions_.size() + 1 >= static_cast<std::size_t>(kPeersMax)) EvictUnproven(now_us);
  for (std::size_t p = 0; p < scene_.players.size(); ++p) {
    if (scene_.players[p].name == name) session.player = static_cast<int>(p);
  }
  const int peer = ChoosePeer(session.player);
  if (peer < 0) {
    Refuse(now_us, session, "the room is full");
    return;
  }
  session.name = name;
  session.peer = peer;
  Welcome welcome;
  welcome.utime = now_us;
  welcome.peer = session.peer;
  welcome.player = session.player;
  welcome.room_bytes = static_cast<std::int32_t>(room_.size());
  session.link.SendReliable(Encode(welcome));
  Note(SessionEvent::Kind::kJoined, session);
}

int SessionTable::ChoosePeer(int player) const {
  std::vector<bool> taken(kPeersMax, false);
  taken[0] = true;
  for (const auto& [address, other] : sessions_) {
    taken[static_cast<std::size_t>(other->peer)] = true;
  }
  // Player p is peer p + 1 wherever possible, so that recordings of a scene agree on who is who;
  // spectators come after the players.
  const auto first = static_cast<std::ptrdiff_t>(scene_.players.size()) + 1;
  const auto own = taken.begin() + player + 1;
  const auto free = player >= 0 && !*own
                        ? own
                        : std::find(taken.begin() + std::min<std::ptrdiff_t>(first, kPeersMax),
                                    taken.end(), false);
  return free == taken.end() ? -1 : static_cast<int>(free - taken.begin());
}

void SessionTable::Refuse(std::int64_t now_us, const Session& session, const std::string& reason) {
  Link link(session.number);
  Bye bye;
  bye.utime = now_us;
  bye.reason = reason;
  link.SendUnreliable(Encode(bye));
  link.Flush(now_us, [&](ByteView datagram) { net_.Send(session.address, datagram); });
}

void SessionTable::NoteHello(Session& session) {
  if (session.stage != SessionStage::kLoading) return;
  session.stage = SessionStage::kReady;
  Note(SessionEvent::Kind::kReady, session);
}

void SessionTable::Advance(std::int64_t now_us) {
  for (auto& [address, session] : sessions_) {
    if (session->stage != SessionStage::kGreeted || session->link.reliable_pending()) continue;
    // The Welcome was acknowledged, so somebody really listens at this address.
    session->stage = SessionStage::kLoading;
    for (std::size_t at = 0; at < room_.size(); at += kChunkBytesMax) {
      const std::size_t end = std::min(room_.size(), at + kChunkBytesMax);
      Chunk chunk;
      chunk.utime = now_us;
      chunk.offset_bytes = static_cast<std::int32_t>(at);
      chunk.data.assign(room_.begin() + static_cast<std::ptrdiff_t>(at),
                        room_.begin() + static_cast<std::ptrdiff_t>(end));
      session->link.SendReliable(Encode(chunk));
    }
    Note(SessionEvent::Kind::kProven, *session);
  }
}

bool SessionTable::EvictUnproven(std::int64_t now_us) {
  auto oldest = sessions_.end();
  for (auto it = sessions_.begin(); it != sessions_.end(); ++it) {
    if (it->second->stage != SessionStage::kGreeted) continue;
    const bool older =
        oldest == sessions_.end() || it->second->created_us < oldest->second->created_us;
    if (older) oldest = it;
  }
  if (oldest == sessions_.end() || now_us - oldest->second->created_us < kProofUs) return false;
  const Address address = oldest->first;
  Drop(address, "others wait and it never proved its address");
  return true;
}

void SessionTable::DropSilent(std::int64_t now_us) {
  std::vector<std::pair<Address, std::string>> gone;
  for (const auto& [address, session] : sessions_) {
    const std::int64_t heard = std::max(session->link.last_receive_us(), session->created_us);
    if (session->created_us < now_us - kHalfOpenUs && session->stage != SessionStage::kReady) {
      gone.emplace_back(address, "never got ready");
    } else if (now_us - heard > kPatienceUs) {
      gone.emplace_back(address, "not heard for " + std::to_string(kPatienceUs / 1000000) + " s");
    } else if (session->leaving) {
      gone.emplace_back(address, session->leaving_why);
    }
  }
  for (const auto& [address, why] : gone) Drop(address, why);
}

void SessionTable::Drop(const Address& address, const std::string& why) {
  const auto found = sessions_.find(address);
  Note(SessionEvent::Kind::kLeft, *found->second, why);
  sessions_.erase(found);
}

void SessionTable::Note(SessionEvent::Kind kind, const Session& session, const std::string& why) {
  SessionEvent event;
  event.kind = kind;
  event.address = session.address;
  event.name = session.name;
  event.peer = session.peer;
  event.player = session.player;
  event.was_ready = session.stage == SessionStage::kReady;
  event.why = why;
  events_.push_back(event);
}

void SessionTable::Close(std::int64_t now_us, const std::string& reason, Stats* stats) {
  Bye bye;
  bye.utime = now_us;
  bye.reason = reason;
  for (int copy = 0; copy < kByeCopies; ++copy) {  // nobody will repeat a lost one
    for (auto& [address, session] : sessions_) session->link.SendUnreliable(Encode(bye));
    Flush(now_us, stats);
  }
  sessions_.clear();
}

}  // namespace seam
