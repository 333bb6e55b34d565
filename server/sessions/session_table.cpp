#include "server/sessions/session_table.h"

#include <algorithm>
#include <limits>

#include "common/net/datagram.h"
#include "common/net/loose_datagram.h"
#include "common/sync/lease.h"

namespace seam {

SessionTable::SessionTable(const Scene& scene, const Bytes& room, const TrafficRate& allowed,
                           Net& net, Entropy& entropy, double bytes_per_s,
                           std::shared_ptr<const KeyPair> identity, TokenDoor door)
    : scene_(scene),
      room_(room),
      allowed_(allowed),
      bytes_per_s_(bytes_per_s),
      net_(net),
      identity_(identity != nullptr ? std::move(identity) : std::make_shared<KeyPair>(entropy)),
      door_(std::move(door)),
      handshake_(net, entropy, *identity_, traffic_, door_),
      epoch_proof_(EpochProof(identity_->secret, door_.room, door_.epoch)),
      places_(scene, entropy) {
  NoteChanged();
}

SessionTable::Verdict SessionTable::Receive(std::int64_t now_us, const Address& from,
                                            const Bytes& datagram, const Deliver& deliver) {
  if (const std::uint64_t number = SessionOfDatagram(datagram)) {
    const auto found = by_number_.find(number);
    if (found != by_number_.end()) {
      return OnSession(now_us, *found->second, from, datagram, deliver);
    }
    traffic_.AddLoose(datagram, false);
    handshake_.RefuseSession(now_us, from, datagram);
    return Verdict::kNoRight;
  }
  traffic_.AddLoose(datagram, false);
  const SessionId id{from, LooseNumber(datagram)};
  if (id.number == 0) return Verdict::kMalformed;
  const auto found = sessions_.find(id);
  if (found != sessions_.end()) {  // a Hello or Join repeated: the welcome has not come yet
    Session& session = *found->second;
    if (session.address == from) session.path.Receive(datagram.size(), 0);
    return Verdict::kTaken;
  }
  return OnStranger(now_us, id, datagram);
}

/// Handles a datagram without a session: the one place that decides the effects of such senders.
SessionTable::Verdict SessionTable::OnStranger(std::int64_t now_us, const SessionId& id,
                                               const Bytes& datagram) {
  JoinRequest join;
  switch (handshake_.Receive(now_us, id.address, id.number, datagram, &join)) {
    case Handshake::Verdict::kForeign: return Verdict::kNoRight;
    case Handshake::Verdict::kAnswered: return Verdict::kTaken;
    case Handshake::Verdict::kJoins: break;
  }
  if (join.epoch_proved && join.epoch > std::max(door_.epoch, shown_epoch_)) {
    shown_epoch_ = join.epoch;
  }
  if (redirect_ && !forsaken_) {
    handshake_.AnswerByRedirect(now_us, id.address, join, *redirect_);
    return Verdict::kTaken;
  }
  const std::string no_entry = NoEntry(join);
  if (!no_entry.empty()) {
    handshake_.Refuse(now_us, id.address, id.number, datagram.size(), no_entry, true);
    return Verdict::kTaken;
  }
  const auto key = static_cast<std::uint64_t>(join.place_key);
  const int abandoned = places_.Abandoned(now_us, join.name, key);
  if (const Session* old = abandoned < 0 ? nullptr : Find(abandoned)) {
    Drop(SessionId(old->id), "silent before it was ready, and its name is claimed");
  }
  const PlaceTable::Answer answer = places_.Claim(now_us, join.name, key, id.number);
  if (answer.peer > 0) {
    handshake_.NoteGranted(now_us, join);
    Admit(now_us, id, join.keys, answer)->path.Receive(datagram.size(), 0);
  } else if (!answer.refusal.empty()) {
    handshake_.Refuse(now_us, id.address, id.number, datagram.size(), answer.refusal, true);
  }
  return Verdict::kTaken;
}

std::string SessionTable::NoEntry(const JoinRequest& join) const {
  if (forsaken_ || join.epoch > door_.epoch) {
    return "the room " + door_.room + " goes on elsewhere, in a later epoch than " +
           std::to_string(door_.epoch);
  }
  if (door_.key == nullptr) return "";
  const bool back = places_.IsOwner(join.name, static_cast<std::uint64_t>(join.place_key));
  if (!join.token && !back) return "a token is needed here: seam-client --token FILE";
  const bool plays = std::any_of(scene_.players.begin(), scene_.players.end(),
                                 [&](const Player& player) { return player.name == join.name; });
  if (join.token && plays && !join.may_play) return "the token lets " + join.name + " only look on";
  return "";
}

Session* SessionTable::Admit(std::int64_t now_us, const SessionId& id, const SealKeys& keys,
                             const PlaceTable::Answer& answer) {
  const int peer = answer.peer;
  if (const Session* old = Find(peer)) {
    const SessionId was = old->id;
    Drop(was, "replaced by a new session with its key");
  }
  const PackedMotion motion(scene_.gravity.x(), scene_.gravity.y(), scene_.solver.tick_hz);
  auto session = std::make_unique<Session>(id, keys, allowed_, bytes_per_s_, motion);
  session->link.SetWatch([this](ByteView plain, bool out) { traffic_.AddPlain(plain, out); });
  const Place& place = places_.at(peer);
  session->name = place.name;
  session->player = place.player;
  session->peer = peer;
  session->created_us = now_us;
  ClientAccount& account = accounts_.Of(place.name);
  account.peer = peer;
  account.player = place.player;
  session->account = &account;
  places_.Enter(peer, now_us);
  Welcome welcome;
  welcome.utime = now_us;
  welcome.peer = peer;
  welcome.player = place.player;
  welcome.room_bytes = static_cast<std::int32_t>(room_.size());
  welcome.key = static_cast<std::int64_t>(answer.key);
  welcome.epoch = door_.epoch;
  welcome.proof = epoch_proof_;
  session->link.SendReliable(Encode(welcome));
  Note(SessionEvent::Kind::kJoined, *session);
  const auto place_of = static_cast<std::size_t>(peer);
  if (by_peer_.size() <= place_of) by_peer_.resize(place_of + 1, nullptr);
  Session* const admitted = session.get();
  by_peer_[place_of] = admitted;
  by_number_[keys.session] = admitted;
  sessions_.emplace(id, std::move(session));
  NoteChanged();
  admitted_ = true;
  silent_us_ = now_us;
  return admitted;
}

SessionTable::Verdict SessionTable::OnSession(std::int64_t now_us, Session& session,
                                              const Address& from, const Bytes& datagram,
                                              const Deliver& deliver) {
  const Link& link = session.link;
  const bool unheard = link.last_receive_us() >= 0 && now_us - link.last_receive_us() > kSilentUs;
  const bool unhearing =
      link.known_until_us() >= 0 && now_us - link.known_until_us() > kSilentUs + link.rtt_us();
  bool over = false;
  const auto gate = [&](std::size_t messages) {
    if (unheard || unhearing) session.account->returned_us = now_us;
    over = !session.budget.Take(now_us, datagram.size(), messages);
    return !over;
  };
  const bool good = session.link.Receive(now_us, datagram, gate,
                                         [&](ByteView message) { deliver(session, message); });
  // What others send under its number is not the client's.
  const bool its_own = good || over || from == session.address;
  if (its_own) session.account->bytes_in += static_cast<std::int64_t>(datagram.size());
  if (!good) traffic_.AddLoose(datagram, false);
  if (over) {
    ++session.account->dropped.budget;
    return Verdict::kOverBudget;
  }
  if (!good) {
    session.account->dropped.malformed += its_own ? 1 : 0;
    return Verdict::kMalformed;
  }
  // Another address of the same client: a router gave it a new one, or it changed its network. An
  // older datagram that somebody sends again from elsewhere does not move it.
  if (session.link.received_newest() && session.address != from) {
    session.address = from;
    session.path.Begin(session.link.sent());
  }
  if (session.address == from) session.path.Receive(datagram.size(), session.link.acknowledged());
  for (const std::int64_t number : session.link.TakeAckedNumbers())
    session.packer.Acknowledge(number);
  places_.Heard(session.peer, now_us, session.stage == SessionStage::kReady);
  return Verdict::kTaken;
}

void SessionTable::NoteReady(Session& session) {
  if (session.stage != SessionStage::kLoading) return;
  session.stage = SessionStage::kReady;
  silent_us_ = 0;  // it may not be silent for as long as it might while it was loading
  NoteChanged();
  ++session.account->sessions;
  Note(SessionEvent::Kind::kReady, session);
}

void SessionTable::Advance(std::int64_t now_us) {
  if (!std::exchange(admitted_, false)) return;
  for (auto& [id, session] : sessions_) {
    if (session->stage != SessionStage::kAdmitted) continue;
    room_.SendAhead(now_us, &session->link, &session->room_sent);
    if (session->room_sent < room_.size()) {
      admitted_ = true;
      continue;
    }
    session->stage = SessionStage::kLoading;
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
  const std::int64_t over_us = session.budget.over_us(now_us);
  if (now_us > ReadyByUs(session)) return "never got ready";
  if (now_us > HeardByUs(session)) {
    return "not heard for " + std::to_string(kPatienceUs / 1000000) + " s";
  }
  if (over_us >= kOverBudgetUs) {
    return "sent more than it may for " + std::to_string(kOverBudgetUs / 1000000) + " s";
  }
  silent_us_ = std::min(
      {silent_us_, HeardByUs(session), now_us + kOverBudgetUs - over_us, ReadyByUs(session)});
  return "";
}

std::int64_t SessionTable::HeardByUs(const Session& session) const {
  const std::int64_t heard_us = std::max(session.link.last_receive_us(), session.created_us);
  return heard_us + kPatienceUs + (session.stage == SessionStage::kReady ? 0 : room_.load_us());
}

std::int64_t SessionTable::ReadyByUs(const Session& session) const {
  if (session.stage == SessionStage::kReady) return std::numeric_limits<std::int64_t>::max();
  return room_.ReadyByUs(session.created_us);
}

void SessionTable::Drop(const SessionId& id, const std::string& why) {
  const auto found = sessions_.find(id);
  const Session& session = *found->second;
  Note(SessionEvent::Kind::kLeft, session, why);
  places_.Leave(session.peer, id.number, session.goodbye);
  by_peer_[static_cast<std::size_t>(session.peer)] = nullptr;
  by_number_.erase(session.link.session());
  sessions_.erase(found);
  NoteChanged();
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
  for (int copy = 0; copy < kByeCopies; ++copy) {  // no retransmission after this
    for (auto& [id, session] : sessions_) {
      session->link.SendUnreliable(Encode(bye));
      FlushTo(now_us, *session, 0, stats);
    }
    net_.Flush();
  }
  sessions_.clear();
  by_peer_.clear();
  by_number_.clear();
  NoteChanged();
}

}  // namespace seam
