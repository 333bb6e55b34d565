#include "server/relay/watcher_table.h"

#include <algorithm>
#include <utility>

#include "common/net/datagram.h"
#include "common/net/loose_datagram.h"
#include "common/sync/lease.h"
#include "server/server.h"
#include "server/sessions/place_table.h"

namespace seam {
namespace {

/// Time between two looks for silent watchers, us: short beside the patience with them.
constexpr std::int64_t kDropEveryUs = 250000;
/// Most watchers of the past that may come back without a new token. A later one takes the place
/// of the first.
constexpr std::size_t kKeysMost = 65536;

}  // namespace

WatcherTable::WatcherTable(Net& net, Entropy& entropy, const WatcherLimits& limits,
                           std::shared_ptr<const KeyPair> identity,
                           std::shared_ptr<const Secret> token_key)
    : net_(net),
      entropy_(entropy),
      limits_(limits),
      identity_(identity != nullptr ? std::move(identity) : std::make_shared<KeyPair>(entropy)),
      token_key_(std::move(token_key)) {}

void WatcherTable::SetRoom(const Joined& joined, const std::string& play_at) {
  Clear();
  if (handshake_ == nullptr || room_ != joined.room.room || welcome_.epoch != joined.epoch) {
    handshake_ = std::make_unique<Handshake>(net_, entropy_, *identity_, traffic_,
                                             TokenDoor{token_key_, joined.room.room, joined.epoch});
  }
  chunks_ = std::make_unique<RoomChunks>(Encode(joined.room));
  room_ = joined.room.room;
  players_.clear();
  for (const Player& player : joined.scene->players) players_.insert(player.name);
  welcome_ = Welcome();
  welcome_.peer = joined.peer;
  welcome_.room_bytes = static_cast<std::int32_t>(chunks_->size());
  welcome_.epoch = joined.epoch;
  redirect_ = Redirect();
  redirect_.address = play_at;
  redirect_.room = room_;
  redirect_.epoch = joined.epoch;
  allowed_ = AllowedTraffic(joined.room.tick_hz, joined.room.send_hz);
}

void WatcherTable::Clear() {
  watchers_.clear();
  by_number_.clear();
  ready_ = 0;
}

void WatcherTable::ReceiveAll(std::int64_t now_us, const Deliver& deliver) {
  Address from;
  Bytes datagram;
  for (int n = 0; n < kDatagramsMax && net_.Receive(&from, &datagram); ++n) {
    stats_.bytes_in += static_cast<std::int64_t>(datagram.size());
    stats_.datagrams_in += 1;
    Receive(now_us, from, datagram, deliver);
  }
}

void WatcherTable::Receive(std::int64_t now_us, const Address& from, const Bytes& datagram,
                           const Deliver& deliver) {
  if (const std::uint64_t number = SessionOfDatagram(datagram)) {
    const auto found = by_number_.find(number);
    if (found != by_number_.end()) {
      return OnWatcher(now_us, *found->second, from, datagram, deliver);
    }
    ++stats_.dropped_right;
    if (handshake_ != nullptr) handshake_->RefuseSession(now_us, from, datagram);
    return;
  }
  const SessionId id{from, LooseNumber(datagram)};
  if (id.number == 0) {
    ++stats_.dropped_malformed;
    return;
  }
  const auto found = watchers_.find(id);
  if (found == watchers_.end()) return OnStranger(now_us, id, datagram);
  Watcher& watcher = *found->second;  // a Hello or Join repeated: the welcome has not come yet
  if (watcher.address == from) watcher.path.Receive(datagram.size(), 0);
}

void WatcherTable::OnStranger(std::int64_t now_us, const SessionId& id, const Bytes& datagram) {
  if (handshake_ == nullptr) return;  // no room yet: it asks again
  JoinRequest join;
  const auto verdict = handshake_->Receive(now_us, id.address, id.number, datagram, &join);
  if (verdict == Handshake::Verdict::kForeign) ++stats_.dropped_right;
  if (verdict != Handshake::Verdict::kJoins) return;
  const std::string no_entry = NoEntry(join);
  if (!no_entry.empty()) {
    handshake_->Refuse(now_us, id.address, id.number, datagram.size(), no_entry, true);
  } else if (players_.count(join.name) != 0) {
    handshake_->AnswerByRedirect(now_us, id.address, join, redirect_);
  } else {
    handshake_->NoteGranted(now_us, join);
    Admit(now_us, id, join);
    watchers_.at(id)->path.Receive(datagram.size(), 0);
  }
}

std::string WatcherTable::NoEntry(const JoinRequest& join) const {
  if (!join.room.empty() && join.room != room_) {
    return "there is no such room here: the room is " + room_;
  }
  if (players_.count(join.name) != 0) return "";  // the server decides
  if (count() >= limits_.watchers) {
    return "the relay is full: it takes " + std::to_string(limits_.watchers) + " watchers";
  }
  const auto key = static_cast<std::uint64_t>(join.place_key);
  const bool back = key != 0 && keys_.count(PlaceTable::KeyHash(key)) != 0;
  if (token_key_ == nullptr || join.token || back) return "";
  return "a token is needed here: seam-client --token FILE";
}

std::uint64_t WatcherTable::DrawKey() {
  std::uint64_t key = 0;
  while (key == 0) key = entropy_.Next();
  if (token_key_ == nullptr) return key;  // nobody asks for it
  keys_in_order_.push_back(PlaceTable::KeyHash(key));
  keys_.insert(keys_in_order_.back());
  if (keys_in_order_.size() > kKeysMost) {
    keys_.erase(keys_in_order_.front());
    keys_in_order_.pop_front();
  }
  return key;
}

void WatcherTable::Admit(std::int64_t now_us, const SessionId& id, const JoinRequest& join) {
  auto watcher = std::make_unique<Watcher>(id, join.keys, allowed_);
  watcher->name = join.name;
  watcher->created_us = now_us;
  Welcome welcome = welcome_;
  welcome.utime = now_us;
  welcome.key = static_cast<std::int64_t>(DrawKey());
  watcher->link.SendReliable(Encode(welcome));
  by_number_[join.keys.session] = watcher.get();
  watchers_.emplace(id, std::move(watcher));
}

void WatcherTable::OnWatcher(std::int64_t now_us, Watcher& watcher, const Address& from,
                             const Bytes& datagram, const Deliver& deliver) {
  bool over = false;
  const auto gate = [&](std::size_t messages) {
    over = !watcher.budget.Take(now_us, datagram.size(), messages);
    return !over;
  };
  const bool good = watcher.link.Receive(now_us, datagram, gate,
                                         [&](ByteView message) { deliver(watcher, message); });
  if (!good) {
    ++(over ? stats_.dropped_budget : stats_.dropped_malformed);
    return;
  }
  // Another address of the same client; an older datagram sent again from elsewhere moves nothing.
  if (watcher.link.received_newest() && watcher.address != from) {
    watcher.address = from;
    watcher.path.Begin(watcher.link.sent());
  }
  if (watcher.address == from) watcher.path.Receive(datagram.size(), watcher.link.acknowledged());
  for (const std::int64_t number : watcher.link.TakeAckedNumbers()) {
    watcher.states.Acknowledge(number);
  }
}

void WatcherTable::Advance(std::int64_t now_us, bool serves,
                           const std::function<void(Watcher&)>& loaded) {
  if (ready_ == count()) return;
  for (auto& [id, watcher] : watchers_) {
    if (watcher->stage != SessionStage::kAdmitted) continue;
    chunks_->SendAhead(now_us, &watcher->link, &watcher->room_sent);
    if (watcher->room_sent < chunks_->size() || !serves) continue;
    watcher->stage = SessionStage::kLoading;
    loaded(*watcher);
    if (watcher->says_ready) NoteReady(*watcher);
  }
}

bool WatcherTable::NoteReady(Watcher& watcher) {
  watcher.says_ready = true;
  if (watcher.stage != SessionStage::kLoading) return false;
  watcher.stage = SessionStage::kReady;
  ++ready_;
  return true;
}

bool WatcherTable::IsOver(std::int64_t now_us, const Watcher& watcher) const {
  const bool is_ready = watcher.stage == SessionStage::kReady;
  const std::int64_t heard_us = std::max(watcher.link.last_receive_us(), watcher.created_us);
  const std::int64_t patience_us = kPatienceUs + (is_ready ? 0 : chunks_->load_us());
  return watcher.leaving || now_us > heard_us + patience_us ||
         (!is_ready && now_us > chunks_->ReadyByUs(watcher.created_us)) ||
         watcher.budget.over_us(now_us) >= kOverBudgetUs;
}

void WatcherTable::DropSilent(std::int64_t now_us) {
  if (now_us < look_us_) return;
  look_us_ = now_us + kDropEveryUs;
  for (auto next = watchers_.begin(); next != watchers_.end();) {
    const Watcher& watcher = *next->second;
    if (!IsOver(now_us, watcher)) {
      ++next;
      continue;
    }
    if (watcher.stage == SessionStage::kReady) --ready_;
    by_number_.erase(watcher.link.session());
    next = watchers_.erase(next);
  }
}

void WatcherTable::SendTo(Watcher& watcher, const Bytes& message) {
  if (!watcher.link.SendReliable(message)) watcher.leaving = true;
}

void WatcherTable::SendToAll(const Bytes& message, bool urgent) {
  for (auto& [id, watcher] : watchers_) {
    if (watcher->stage == SessionStage::kAdmitted) continue;
    Link& link = watcher->link;
    if (!(urgent ? link.SendUrgent(message) : link.SendReliable(message))) watcher->leaving = true;
  }
}

void WatcherTable::FlushTo(std::int64_t now_us, Watcher& watcher) {
  const auto send = [&](ByteView datagram) {
    if (!watcher.path.Spend(datagram.size)) return;  // as if lost on the way
    stats_.bytes_out += static_cast<std::int64_t>(datagram.size);
    stats_.datagrams_out += 1;
    watcher.credit.Spend(datagram.size);
    net_.Send(watcher.address, datagram);
  };
  const auto credit = static_cast<std::size_t>(std::max(0.0, watcher.credit.bytes()));
  watcher.link.Flush(now_us, send, std::min(credit, watcher.path.left()));
}

bool WatcherTable::Carries(std::int64_t now_us, Watcher& watcher) const {
  const double path = watcher.link.rate().bytes_per_s();
  const double most = limits_.bytes_per_s;
  watcher.credit.Fill(now_us, most > 0 ? std::min(most, path) : path);
  return watcher.credit.Ready();
}

void WatcherTable::Flush(std::int64_t now_us) {
  for (auto& [id, watcher] : watchers_) {
    if (watcher->link.Sends(now_us) && Carries(now_us, *watcher)) FlushTo(now_us, *watcher);
  }
  if (handshake_ != nullptr) {
    handshake_->Forget(now_us);
    handshake_->Count(&stats_);
  }
  net_.Flush();
}

void WatcherTable::Close(std::int64_t now_us, const std::string& reason) {
  Bye bye;
  bye.utime = now_us;
  bye.reason = reason;
  const Bytes message = Encode(bye);
  for (int copy = 0; copy < kByeCopies; ++copy) {  // no retransmission after this
    for (auto& [id, watcher] : watchers_) {
      watcher->link.SendUnreliable(message);
      FlushTo(now_us, *watcher);
    }
    net_.Flush();
  }
  Clear();
}

}  // namespace seam
