#include "server/hub/hub.h"

#include <algorithm>
#include <set>

#include "common/base/check.h"
#include "common/base/process.h"
#include "common/net/datagram.h"
#include "common/net/farewell.h"
#include "common/net/loose_datagram.h"
#include "common/physics/prepare_threads.h"

namespace seam {
namespace {

constexpr std::int64_t kWaitUs = 20000;
/// A join waits so long for its room, us, normal 50 000: the client has asked several times more
/// by then. Most that wait, of clients that have proved their addresses: the players of four rooms.
constexpr std::int64_t kJoinWaitsUs = 1000000;
constexpr std::size_t kJoinsWaitMax = 1024;

std::vector<std::string> NamesOfRooms(const std::vector<RoomPlan>& plans) {
  std::vector<std::string> names;
  for (const RoomPlan& plan : plans) names.push_back(plan.config.room);
  SEAM_ASSERT(std::set<std::string>(names.begin(), names.end()).size() == names.size());
  return names;
}

}  // namespace

Hub::Hub(const std::vector<RoomPlan>& plans, UdpNet& udp, std::shared_ptr<const KeyPair> identity,
         std::shared_ptr<const Secret> token_key)
    : udp_(udp),
      finder_(NamesOfRooms(plans)),
      identity_(std::move(identity)),
      handshake_(udp, entropy_, *identity_, traffic_, TokenDoor{std::move(token_key), ""}),
      mail_(plans.size()) {
  for (std::size_t r = 0; r < plans.size(); ++r) {
    senders_.push_back(std::make_unique<UdpSender>(udp));
    rooms_.push_back(
        std::make_unique<HostedRoom>(plans[r], static_cast<int>(r), finder_, *senders_[r]));
  }
}

Hub::~Hub() = default;

void Hub::Start(int workers) {
  PrepareForThreads();
  std::vector<Runnable*> rooms;
  for (const auto& room : rooms_) rooms.push_back(room.get());
  lanes_ = std::make_unique<Lanes>(rooms, workers);
}

void Hub::Add(const RoomPlan& plan) {
  senders_.push_back(std::make_unique<UdpSender>(udp_));
  const int index = static_cast<int>(rooms_.size());
  auto room = std::make_unique<HostedRoom>(plan, index, finder_, *senders_.back());
  finder_.Add(plan.config.room);
  rooms_.push_back(std::move(room));
  mail_.push_back(false);
  if (lanes_ != nullptr) lanes_->Add(rooms_.back().get());
  DeliverKept(SteadyClockUs(), index);
}

void Hub::Keep(std::int64_t now_us, const Address& from, const std::string& room,
               const Bytes& datagram) {
  const auto gone = [&](const WaitingJoin& join) {
    return join.from == from || now_us - join.at_us > kJoinWaitsUs;
  };
  waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(), gone), waiting_.end());
  if (waiting_.size() >= kJoinsWaitMax) waiting_.erase(waiting_.begin());
  waiting_.push_back({from, room, datagram, now_us});
}

void Hub::DeliverKept(std::int64_t now_us, int room) {
  HostedRoom& here = *rooms_[static_cast<std::size_t>(room)];
  for (auto join = waiting_.begin(); join != waiting_.end();) {
    if (join->room != here.config().room) {
      ++join;
      continue;
    }
    if (now_us - join->at_us <= kJoinWaitsUs) here.Deliver(join->from, std::move(join->datagram));
    mail_[static_cast<std::size_t>(room)] = true;
    join = waiting_.erase(join);
  }
}

void Hub::OnUnknownRoom(std::int64_t now_us, const Address& from, std::uint64_t number,
                        const Bytes& datagram) {
  if (!elsewhere_) {
    handshake_.Refuse(now_us, from, number, datagram.size(), finder_.Refusal(), false);
    return;
  }
  JoinRequest join;
  const auto verdict = handshake_.Receive(now_us, from, number, datagram, &join);
  if (verdict != Handshake::Verdict::kJoins) return;
  const std::optional<Redirect> to = elsewhere_(join);
  if (to && to->address.empty()) return Keep(now_us, from, join.room, datagram);
  if (to) {
    handshake_.AnswerByRedirect(now_us, from, join, *to);
  } else {
    handshake_.Refuse(now_us, from, number, datagram.size(), finder_.Refusal(), true);
  }
}

void Hub::Drain(const std::function<bool()>& may_be_taken, const Where& where) {
  drains_ = true;
  const auto left = [](const auto& room) { return !room->done() && !room->over(); };
  while (std::any_of(rooms_.begin(), rooms_.end(), left) && may_be_taken()) {
    Poll(SteadyClockUs());
    Wait();
  }
  for (std::size_t r = 0; r < rooms_.size(); ++r) {
    HostedRoom& room = *rooms_[r];
    if (room.done() || room.over()) continue;
    if (lanes_ != nullptr) lanes_->Hold(static_cast<int>(r));
    GiveAway(room, where);
    if (lanes_ != nullptr) lanes_->Free(static_cast<int>(r));
    Poll(SteadyClockUs());
  }
  lanes_.reset();
  const std::int64_t deadline_us = SteadyClockUs() + kDrainUsMax;
  const auto told = [](const auto& room) {
    return !room->over() || room->server().all_redirected();
  };
  while (SteadyClockUs() < deadline_us && !std::all_of(rooms_.begin(), rooms_.end(), told)) {
    Poll(SteadyClockUs());
    Wait();
  }
}

void Hub::GiveAway(HostedRoom& room, const Where& where) {
  if (room.done() || room.over()) return;  // it was while it was waited for
  const std::int32_t epoch = room.GiveAway(SteadyClockUs());
  const Redirect to = where(room.config().room, epoch);
  if (to.address.empty()) {
    room.EndGivenAway(SteadyClockUs());
    return;
  }
  room.RedirectAll(SteadyClockUs(), to);
}

bool Hub::AsksForOver(int room, const Bytes& datagram) const {
  if (room < 0 || !elsewhere_ || drains_ || LooseNumber(datagram) == 0) return false;
  return rooms_[static_cast<std::size_t>(room)]->over();
}

void Hub::Take(std::int64_t now_us) {
  handshake_.Forget(now_us);
  Address from;
  Bytes datagram;
  for (int n = 0; n < kDatagramsMax && udp_.Receive(&from, &datagram); ++n) {
    const int room = finder_.Find(now_us, datagram);
    if (AsksForOver(room, datagram)) {
      OnUnknownRoom(now_us, from, LooseNumber(datagram), datagram);
      continue;
    }
    if (room >= 0) {
      rooms_[static_cast<std::size_t>(room)]->Deliver(from, std::move(datagram));
      mail_[static_cast<std::size_t>(room)] = true;
      continue;
    }
    const std::uint64_t number = room == RoomFinder::kNone ? 0 : LooseNumber(datagram);
    JoinRequest join;
    if (number != 0 && room == RoomFinder::kHello) {
      handshake_.Receive(now_us, from, number, datagram, &join);
    } else if (number != 0) {
      OnUnknownRoom(now_us, from, number, datagram);
    } else {
      ++strangers_;
      if (SessionOfDatagram(datagram) != 0) handshake_.RefuseSession(now_us, from, datagram);
    }
  }
  udp_.Flush();
}

void Hub::Poll(std::int64_t now_us) {
  wake_policy_.NotePolled(now_us);
  Take(now_us);
  for (std::size_t r = 0; r < rooms_.size(); ++r) {
    const bool mail = mail_[r];
    mail_[r] = false;
    if (lanes_ != nullptr) {
      if (mail) lanes_->Wake(static_cast<int>(r));
    } else if (mail || rooms_[r]->due_us() <= now_us) {
      rooms_[r]->Run(SteadyClockUs());
    }
  }
}

void Hub::Wait() {
  std::int64_t due_us = SteadyClockUs() + kWaitUs;
  if (lanes_ == nullptr) {
    for (const auto& room : rooms_) due_us = std::min(due_us, room->due_us());
  }
  SleepUs(wake_policy_.SleepsUntil(due_us) - SteadyClockUs());
  const bool came = udp_.Wait(std::max<std::int64_t>(0, due_us - SteadyClockUs()));
  wake_policy_.NoteWaited(SteadyClockUs(), came);
}

bool Hub::done() const {
  return std::all_of(rooms_.begin(), rooms_.end(), [](const auto& room) { return room->done(); });
}

bool Hub::AllRan(std::int64_t since_us) const {
  return std::all_of(rooms_.begin(), rooms_.end(), [since_us](const auto& room) {
    return room->done() || room->ran_us() >= since_us;
  });
}

void Hub::Close() {
  lanes_.reset();
  for (const auto& room : rooms_) room->Close(SteadyClockUs());
  const std::int64_t deadline_us = SteadyClockUs() + kDrainUsMax;
  for (bool under_way = true; under_way && SteadyClockUs() < deadline_us;) {
    under_way = false;
    for (const auto& room : rooms_) under_way = room->DrainNetwork(SteadyClockUs()) || under_way;
    if (under_way) udp_.Wait(1000);
  }
}

std::vector<RoomLoad> Hub::Loads() const {
  std::vector<RoomLoad> loads;
  for (const auto& room : rooms_) {
    RoomLoad load = room->newest();
    if (load.load.utime > 0) loads.push_back(std::move(load));
  }
  return loads;
}

std::vector<std::string> Hub::TakeReports() {
  std::vector<std::string> all;
  for (const auto& room : rooms_) {
    for (std::string& news : room->TakeReports()) all.push_back(std::move(news));
  }
  return all;
}

}  // namespace seam
