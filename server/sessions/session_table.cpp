#include "server/sessions/session_table.h"

#include <algorithm>

#include "common/net/datagram.h"
#include "common/sync/lease.h"

namespace seam {
namespace {

/// A session that never gets ready is dropped after this, us.
constexpr std::int64_t kHalfOpenUs = 10000000;
/// A goodbye is sent this often, each in a datagram of its own: a burst of losses, as of profile
/// 4g, easily takes four in a row.
constexpr int kByeCopies = 12;

}  // namespace

SessionTable::SessionTable(const Scene& scene, Bytes room, const TrafficRate& allowed, Net& net,
                           Entropy& entropy, double bytes_per_s)
    : scene_(scene),
      room_(std::move(room)),
      allowed_(allowed),
      bytes_per_s_(bytes_per_s),
      net_(net),
      handshake_(net, entropy),
      places_(scene, entropy) {
  NoteChanged();
}

SessionTable::Verdict SessionTable::Receive(std::int64_t now_us, const Address& from,
                                            const Bytes& datagram, const Deliver& deliver) {
  DatagramHeader header;
  if (!ReadHeader(datagram, &header)) return Verdict::kMalformed;
  const SessionId id{from, header.session};
  const auto found = sessions_.find(id);
  // Another number from a known address is another session; existing ones are not affected.
  if (found == sessions_.end()) return OnStranger(now_us, id, datagram);
  if (header.loose()) return Verdict::kTaken;  // a Hello or Join that was repeated, too late
  return OnSession(now_us, *found->second, datagram, deliver);
}

/// Handles a datagram without a session: the one place that decides the effects of such senders.
SessionTable::Verdict SessionTable::OnStranger(std::int64_t now_us, const SessionId& id,
                                               const Bytes& datagram) {
  Join join;
  switch (handshake_.Receive(now_us, id.address, id.number, datagram, &join)) {
    case Handshake::Verdict::kForeign: return Verdict::kNoRight;
    case Handshake::Verdict::kAnswered: return Verdict::kTaken;
    case Handshake::Verdict::kJoins: break;
  }
  const auto key = static_cast<std::uint64_t>(join.key);
  const int abandoned = places_.Abandoned(now_us, join.name, key);
  if (const Session* old = abandoned < 0 ? nullptr : Find(abandoned)) {
    Drop(SessionId(old->id), "silent before it was ready, and its name is claimed");
  }
  const PlaceTable::Answer answer = places_.Claim(now_us, join.name, key, id.number);
  if (answer.peer > 0) {
    Admit(now_us, id, answer.peer);
  } else if (!answer.refusal.empty()) {
    handshake_.Refuse(now_us, id.address, id.number, datagram.size(), answer.refusal);
  }
  return Verdict::kTaken;
}

void SessionTable::Admit(std::int64_t now_us, const SessionId& id, int peer) {
  if (const Session* old = Find(peer)) {
    const SessionId was = old->id;
    Drop(was, "replaced by a new session with its key");
  }
  const PackedMotion motion(scene_.gravity.x(), scene_.gravity.y(), scene_.solver.tick_hz);
  auto session = std::make_unique<Session>(id, allowed_, bytes_per_s_, motion);
  const Place& place = places_.at(peer);
  session->name = place.name;
  session->player = place.player;
  session->peer = peer;
  session->created_us = now_us;
  ClientAccount& account = accounts_.Of(place.name);
  account.peer = peer;
  account.player = place.player >= 0;
  session->account = &account;
  places_.Enter(peer, now_us);
  Welcome welcome;
  welcome.utime = now_us;
  welcome.peer = peer;
  welcome.player = place.player;
  welcome.room_bytes = static_cast<std::int32_t>(room_.size());
  welcome.key = static_cast<std::int64_t>(place.key);
  session->link.SendReliable(Encode(welcome));
  Note(SessionEvent::Kind::kJoined, *session);
  const auto place_of = static_cast<std::size_t>(peer);
  if (by_peer_.size() <= place_of) by_peer_.resize(place_of + 1, nullptr);
  by_peer_[place_of] = session.get();
  sessions_.emplace(id, std::move(session));
  NoteChanged();
  admitted_ = true;
  silent_us_ = now_us;
}

SessionTable::Verdict SessionTable::OnSession(std::int64_t now_us, Session& session,
                                              const Bytes& datagram, const Deliver& deliver) {
  bool over = false;
  const auto gate = [&](std::size_t messages) {
    over = !session.budget.Take(now_us, datagram.size(), messages);
    return !over;
  };
  const bool good = session.link.Receive(now_us, datagram, gate,
                                         [&](ByteView message) { deliver(session, message); });
  session.account->bytes_in += static_cast<std::int64_t>(datagram.size());
  if (over) {
    ++session.account->dropped.budget;
    return Verdict::kOverBudget;
  }
  if (!good) {
    ++session.account->dropped.malformed;
    return Verdict::kMalformed;
  }
  for (const std::int64_t number : session.link.TakeAckedNumbers())
    session.packer.Acknowledge(number);
  places_.Heard(session.peer, now_us, session.stage == SessionStage::kReady);
  return Verdict::kTaken;
}

void SessionTable::NoteReady(Session& session) {
  if (session.stage != SessionStage::kLoading) return;
  session.stage = SessionStage::kReady;
  NoteChanged();
  ++session.account->sessions;
  Note(SessionEvent::Kind::kReady, session);
}

void SessionTable::Advance(std::int64_t now_us) {
  if (!std::exchange(admitted_, false)) return;
  for (auto& [id, session] : sessions_) {
    if (session->stage != SessionStage::kAdmitted) continue;
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
    Note(SessionEvent::Kind::kLoading, *session);
  }
}

void SessionTable::DropSilent(std::int64_t now_us) {
  const bool look = now_us >= silent_us_;
  if (!look && !leaving_) return;
  leaving_ = false;
  std::vector<std::pair<SessionId, std::string>> gone;
  if (look) silent_us_ = now_us + kOverBudgetUs;
  for (const auto& [id, session] : sessions_) {
    if (look) {
      const std::string why = TooLong(now_us, *session);
      if (!why.empty()) {
        gone.emplace_back(id, why);
        continue;
      }
    }
    if (session->leaving) gone.emplace_back(id, session->leaving_why);
  }
  for (const auto& [id, why] : gone) Drop(id, why);
}

/// Returns why the session has to be dropped now, or "". In that case silent_us_ is brought forward
/// to the earliest time at which it may have to be.
std::string SessionTable::TooLong(std::int64_t now_us, const Session& session) {
  const std::int64_t heard = std::max(session.link.last_receive_us(), session.created_us);
  const std::int64_t over_us = session.budget.over_us(now_us);
  if (session.created_us < now_us - kHalfOpenUs && session.stage != SessionStage::kReady) {
    return "never got ready";
  }
  if (now_us - heard > kPatienceUs) {
    return "not heard for " + std::to_string(kPatienceUs / 1000000) + " s";
  }
  if (over_us >= kOverBudgetUs) {
    return "sent more than it may for " + std::to_string(kOverBudgetUs / 1000000) + " s";
  }
  silent_us_ = std::min({silent_us_, heard + kPatienceUs, now_us + kOverBudgetUs - over_us});
  if (session.stage != SessionStage::kReady) {
    silent_us_ = std::min(silent_us_, session.created_us + kHalfOpenUs);
  }
  return "";
}

void SessionTable::Drop(const SessionId& id, const std::string& why) {
  const auto found = sessions_.find(id);
  const Session& session = *found->second;
  Note(SessionEvent::Kind::kLeft, session, why);
  places_.Leave(session.peer, id.number, session.goodbye);
  by_peer_[static_cast<std::size_t>(session.peer)] = nullptr;
  sessions_.erase(found);
  NoteChanged();
}

void SessionTable::Note(SessionEvent::Kind kind, const Session& session, const std::string& why) {
  SessionEvent event;
  event.kind = kind;
  event.address = session.id.address;
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
  for (int copy = 0; copy < kByeCopies; ++copy) {  // no retransmission after this
    for (auto& [id, session] : sessions_) {
      session->link.SendUnreliable(Encode(bye));
      FlushTo(now_us, *session, 0, stats);
    }
    net_.Flush();
  }
  sessions_.clear();
  by_peer_.clear();
  NoteChanged();
}

}  // namespace seam
