/// Server, clients' comings and goings.

#include <algorithm>

#include "common/codec/codec.h"
#include "server/rules/rules.h"
#include "server/server.h"

namespace seam {
namespace {

constexpr std::size_t kChunkBytes = 1000;
/// A session that never proves its address or never gets ready is forgotten after this, us.
constexpr std::int64_t kHalfOpenUs = 10000000;
/// Time an address has to prove itself when others wait for its place, us: forged hellos must not
/// fill the room.
constexpr std::int64_t kProofUs = 1000000;
/// A goodbye is sent this often, each in a datagram of its own.
constexpr int kByeCopies = 4;
/// A name is free for a new session (a restarted client) when the old one was silent this long, us.
constexpr std::int64_t kNameHeldUs = 1000000;

}  // namespace

void Server::Admit(std::int64_t now_us, Session& session, const std::string& name) {
  const auto same = std::find_if(sessions_.begin(), sessions_.end(),
                                 [&](const auto& s) { return s.second->name == name; });
  if (same != sessions_.end()) {
    if (now_us - same->second->link.last_receive_us() < kNameHeldUs) {
      Refuse(now_us, session.address, session.number, "the name " + name + " is in use");
      return;
    }
    const Address old = same->first;
    Drop(now_us, old, "replaced by a new session of the same name");
  }
  if (sessions_.size() + 1 >= static_cast<std::size_t>(kPeersMax)) EvictUnproven(now_us);
  std::vector<bool> taken(kPeersMax, false);
  taken[0] = true;
  for (const auto& [address, other] : sessions_) {
    taken[static_cast<std::size_t>(other->peer)] = true;
  }
  for (std::size_t p = 0; p < scene_.players.size(); ++p) {
    if (scene_.players[p].name == name) session.player = static_cast<int>(p);
  }
  // Player p is peer p + 1 wherever possible, so that recordings of a scene agree on who is who;
  // spectators come after the players.
  const auto first = static_cast<std::ptrdiff_t>(scene_.players.size()) + 1;
  const auto own = taken.begin() + session.player + 1;
  const auto free = session.player >= 0 && !*own
                        ? own
                        : std::find(taken.begin() + std::min<std::ptrdiff_t>(first, kPeersMax),
                                    taken.end(), false);
  if (free == taken.end()) {
    Refuse(now_us, session.address, session.number, "the room is full");
    return;
  }
  session.name = name;
  session.peer = static_cast<int>(free - taken.begin());
  Welcome welcome;
  welcome.utime = now_us;
  welcome.peer = session.peer;
  welcome.player = session.player;
  welcome.room_bytes = static_cast<std::int32_t>(Encode(MakeRoom(0)).size());
  session.link.SendReliable(Encode(welcome));
  Say(now_us, name + " joins from " + ToString(session.address) + " as peer " +
                  std::to_string(session.peer));
}

void Server::Refuse(std::int64_t now_us, const Address& to, std::uint64_t number,
                    const std::string& reason) {
  Link link(number);
  Bye bye;
  bye.utime = now_us;
  bye.reason = reason;
  link.SendUnreliable(Encode(bye));
  link.Flush(now_us, [&](ByteView datagram) { net_.Send(to, datagram); });
}

void Server::Advance(std::int64_t now_us, Session& session) {
  if (session.stage != SessionStage::kGreeted || session.link.reliable_pending()) return;
  // The Welcome was acknowledged, so somebody really listens at this address.
  session.stage = SessionStage::kLoading;
  const Bytes room = Encode(MakeRoom(0));
  for (std::size_t at = 0; at < room.size(); at += kChunkBytes) {
    Chunk chunk;
    chunk.utime = now_us;
    chunk.offset_bytes = static_cast<std::int32_t>(at);
    chunk.data.assign(
        room.begin() + static_cast<std::ptrdiff_t>(at),
        room.begin() + static_cast<std::ptrdiff_t>(std::min(room.size(), at + kChunkBytes)));
    session.link.SendReliable(Encode(chunk));
  }
  SendWorld(now_us, session);
  SendRules(now_us, session);
}

std::vector<int> Server::PeerOfPlayer() const {
  std::vector<int> peers(scene_.players.size(), -1);
  for (const auto& [address, session] : sessions_) {
    if (session->player >= 0 && session->stage == SessionStage::kReady) {
      peers[static_cast<std::size_t>(session->player)] = session->peer;
    }
  }
  return peers;
}

bool Server::EvictUnproven(std::int64_t now_us) {
  auto oldest = sessions_.end();
  for (auto it = sessions_.begin(); it != sessions_.end(); ++it) {
    if (it->second->stage != SessionStage::kGreeted) continue;
    const bool older =
        oldest == sessions_.end() || it->second->created_us < oldest->second->created_us;
    if (older) oldest = it;
  }
  if (oldest == sessions_.end() || now_us - oldest->second->created_us < kProofUs) return false;
  const Address address = oldest->first;
  Drop(now_us, address, "others wait and it never proved its address");
  return true;
}

void Server::DropSilent(std::int64_t now_us) {
  std::vector<std::pair<Address, std::string>> gone;
  for (const auto& [address, session] : sessions_) {
    const std::int64_t heard = std::max(session->link.last_receive_us(), session->created_us);
    if (session->created_us < now_us - kHalfOpenUs && session->stage != SessionStage::kReady) {
      gone.emplace_back(address, "never got ready");
    } else if (now_us - heard > kSilentUs) {
      gone.emplace_back(address, "not heard for " + std::to_string(kSilentUs / 1000000) + " s");
    } else if (session->leaving) {
      gone.emplace_back(address, session->leaving_why);
    }
  }
  for (const auto& [address, why] : gone) Drop(now_us, address, why);
}

void Server::Drop(std::int64_t now_us, const Address& address, const std::string& why) {
  const auto found = sessions_.find(address);
  if (found == sessions_.end()) return;
  Say(now_us,
      found->second->name + " (peer " + std::to_string(found->second->peer) + ") is gone: " + why);
  const int peer = found->second->peer;
  const bool played = found->second->player >= 0 && found->second->stage == SessionStage::kReady;
  if (rules_ != nullptr && played) rules_->OnLeave(found->second->player);
  sessions_.erase(found);
  Announce(authority_.TakeBack(now_us, peer));
}

void Server::FlushAll(std::int64_t now_us) {
  for (auto& [address, session] : sessions_) {
    const Address to = address;
    session->link.Flush(now_us, [&](ByteView datagram) {
      stats_.bytes_out += static_cast<std::int64_t>(datagram.size);
      stats_.datagrams_out += 1;
      net_.Send(to, datagram);
    });
  }
  net_.Flush();
}

void Server::Shutdown(std::int64_t now_us, const std::string& reason) {
  Bye bye;
  bye.utime = now_us;
  bye.reason = reason;
  for (int copy = 0; copy < kByeCopies; ++copy) {  // nobody will repeat a lost one
    for (auto& [address, session] : sessions_) session->link.SendUnreliable(Encode(bye));
    FlushAll(now_us);
  }
  sessions_.clear();
}

}  // namespace seam
