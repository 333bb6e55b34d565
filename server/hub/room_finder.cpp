#include "server/hub/room_finder.h"

#include <algorithm>
#include <variant>

#include "common/codec/codec.h"
#include "common/net/datagram.h"
#include "common/net/loose_datagram.h"

namespace seam {
namespace {

/// Period of the search for old sessions, us.
constexpr std::int64_t kSweepUs = 5000000;

}  // namespace

int RoomFinder::Asked(ByteView datagram) const {
  if (LooseNumber(datagram) == 0) return kNone;
  const AnyMessage any = Decode(LooseMessage(datagram));
  if (std::holds_alternative<Hello>(any)) return kHello;
  const auto* join = std::get_if<Join>(&any);
  if (join == nullptr) return kNone;
  if (join->room.empty()) return rooms_.empty() ? kUnknown : 0;
  const auto found = std::find(rooms_.begin(), rooms_.end(), join->room);
  return found == rooms_.end() ? kUnknown : static_cast<int>(found - rooms_.begin());
}

int RoomFinder::Find(std::int64_t now_us, ByteView datagram) {
  const std::uint64_t session = SessionOfDatagram(datagram);  // the room opens it
  if (session != 0) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = routes_.find(session);
    if (found != routes_.end()) {
      found->second.heard_us = now_us;
      return found->second.room;
    }
  }
  const int asked = session == 0 ? Asked(datagram) : kNone;
  return asked != kUnknown && rooms_.size() == 1 ? 0 : asked;
}

int RoomFinder::Add(const std::string& room) {
  for (std::string& other : rooms_) {
    if (other == room) other.clear();
  }
  rooms_.push_back(room);
  return static_cast<int>(rooms_.size()) - 1;
}

std::string RoomFinder::Refusal() const {
  if (rooms_.empty()) return "there is no room here";
  constexpr std::size_t kNamedMax = 8;
  std::string line = "there is no such room here: ";
  const char* before = rooms_.size() == 1 ? "the room is " : "the rooms are ";
  for (std::size_t r = 0; r < std::min(kNamedMax, rooms_.size()); ++r) {
    line += before + rooms_[r];
    before = ", ";
  }
  return rooms_.size() > kNamedMax ? line + ", ..." : line;
}

void RoomFinder::Learn(std::int64_t now_us, int room, std::uint64_t session) {
  const std::lock_guard<std::mutex> lock(mutex_);
  routes_[session] = {room, now_us};
  if (now_us - swept_us_ >= kSweepUs) ForgetOld(now_us);
}

void RoomFinder::ForgetOld(std::int64_t now_us) {
  swept_us_ = now_us;
  for (auto route = routes_.begin(); route != routes_.end();) {
    route = now_us - route->second.heard_us > kKeepUs ? routes_.erase(route) : std::next(route);
  }
}

std::size_t RoomFinder::count() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return routes_.size();
}

}  // namespace seam
