/// SessionTable: functions over many sessions at once.

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/sessions/session_table.h"

namespace seam {

Session* SessionTable::Find(int peer) {
  const auto place = static_cast<std::size_t>(peer);
  return peer < 0 || place >= by_peer_.size() ? nullptr : by_peer_[place];
}

int SessionTable::player_count() const {
  const std::vector<int>& peers = PeerOfPlayer();
  return static_cast<int>(std::count_if(peers.begin(), peers.end(), [](int p) { return p >= 0; }));
}

void SessionTable::NoteChanged() {
  in_order_.clear();
  peer_of_player_.assign(scene_.players.size(), -1);
  for (const auto& [id, session] : sessions_) {
    in_order_.push_back(session.get());
    if (session->player >= 0 && session->stage == SessionStage::kReady) {
      peer_of_player_[static_cast<std::size_t>(session->player)] = session->peer;
    }
  }
}

std::int64_t SessionTable::WorstRttUs() const {
  std::int64_t worst = -1;
  for (const auto& [id, session] : sessions_) {
    worst = std::max(worst, session->link.rtt_us());
  }
  return worst;
}

std::int64_t SessionTable::WorstLossPpm() const {
  std::int64_t worst = 0;
  for (const auto& [id, session] : sessions_) {
    worst = std::max(worst, session->link.loss_ppm());
  }
  return worst;
}

void SessionTable::ReadAccounts(Connections* connections) {
  double least = 0;
  connections->thin_lines = 0;
  ForEachReady(0, [&](Session& session) {
    const Link& link = session.link;
    session.account->Read(link.rtt_us(), link.loss_ppm());
    const double line = session.send_queue.bytes_per_s();
    least = least <= 0 ? line : std::min(least, line);
    connections->thin_lines += session.send_queue.IsThin() ? 1 : 0;
    if (link.rtt_us() < 0) return;
    connections->round_trip.Add(link.rtt_us());
    connections->queue.Add(link.rate().queue_us());
    connections->loss.Add(link.loss_ppm());
  });
  connections->least_line = std::llround(least);
}

void SessionTable::SendToAll(const Bytes& message, int but_peer) {
  ForEachSentRoom([&](Session& session) {
    if (session.peer != but_peer) SendTo(session, message);
  });
}

void SessionTable::SendUrgentToAll(const Bytes& message) {
  ForEachSentRoom([&](Session& session) { SendUrgentTo(session, message); });
}

void SessionTable::SendTo(Session& session, const Bytes& message) {
  LeaveUnless(session.link.SendReliable(message), session);
}

void SessionTable::SendUrgentTo(Session& session, const Bytes& message) {
  LeaveUnless(session.link.SendUrgent(message), session);
}

void SessionTable::LeaveUnless(bool sent, Session& session) {
  if (!sent) Leave(session, "does not acknowledge");
}

void SessionTable::Leave(Session& session, const std::string& why) {
  leaving_ = true;
  if (std::exchange(session.leaving, true)) return;
  session.leaving_why = why;
}

void SessionTable::FlushTo(std::int64_t now_us, Session& session, std::size_t reliable_bytes,
                           Stats* stats) {
  const Address to = session.address;
  const auto send = [&](ByteView datagram) {
    if (!session.path.Spend(datagram.size)) return;  // as if lost on the way
    stats->bytes_out += static_cast<std::int64_t>(datagram.size);
    stats->datagrams_out += 1;
    session.account->bytes_out += static_cast<std::int64_t>(datagram.size);
    session.send_queue.Spend(datagram.size);
    net_.Send(to, datagram);
  };
  session.link.Flush(now_us, send, std::min(reliable_bytes, session.path.left()));
}

void SessionTable::RedirectAll(const Redirect& redirect) {
  redirect_ = redirect;
  for (Session* const session : in_order_) session->link.SendUrgent(Encode(redirect));
}

void SessionTable::Forsake() {
  forsaken_ = true;
  sessions_.clear();
  by_peer_.clear();
  by_number_.clear();
  NoteChanged();
}

std::vector<int> SessionTable::Returned(std::int64_t now_us, std::int64_t within_us) const {
  std::vector<int> players;
  for (const Session* const session : in_order_) {
    const std::int64_t returned_us = session->account->returned_us;
    const bool of_late = returned_us >= 0 && now_us - returned_us < within_us;
    if (of_late && session->player >= 0) players.push_back(session->player);
  }
  return players;
}

bool SessionTable::AllTold() const {
  return std::none_of(in_order_.begin(), in_order_.end(),
                      [](const Session* session) { return session->link.reliable_pending(); });
}

void SessionTable::Flush(std::int64_t now_us, Stats* stats) {
  for (Session* const session : in_order_) {
    if (!session->link.Sends(now_us) || !session->send_queue.Ready(now_us)) continue;
    FlushTo(now_us, *session, session->send_queue.allowed(), stats);
    const LineRate& rate = session->link.rate();
    session->send_queue.SetPath(rate.bytes_per_s(), rate.full());
  }
  handshake_.Forget(now_us);
  handshake_.Count(stats);
  net_.Flush();
}

}  // namespace seam
