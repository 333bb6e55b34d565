#include "server/hub/room_net.h"

#include "common/net/datagram.h"

namespace seam {
namespace {

/// More sessions than a room ever has at a time; above this, all are learned anew.
constexpr std::size_t kLearnedMax = 8192;

}  // namespace

void RoomNet::Deliver(const Address& from, Bytes datagram) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (inbox_.size() >= kInboxMax) {
    ++lost_;
  } else {
    inbox_.emplace_back(from, std::move(datagram));
  }
}

bool RoomNet::HasMail() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return !inbox_.empty();
}

void RoomNet::Advance(std::int64_t now_us) {
  now_us_ = now_us;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (taken_.empty()) {
    taken_.swap(inbox_);
  } else {
    for (auto& datagram : inbox_) taken_.push_back(std::move(datagram));
    inbox_.clear();
  }
}

bool RoomNet::Receive(Address* from, Bytes* datagram) {
  if (taken_.empty()) return false;
  *from = taken_.front().first;
  *datagram = std::move(taken_.front().second);
  taken_.pop_front();
  return true;
}

/// Sends, and tells the finder each new session. Only admitted clients get datagrams of a session,
/// so the finder knows it before the client's first answer can arrive.
void RoomNet::Send(const Address& to, ByteView datagram) {
  const std::uint64_t session = SessionOfDatagram(datagram);
  if (session != 0 && learned_.insert(session).second) {
    if (learned_.size() > kLearnedMax) learned_ = {session};
    finder_.Learn(now_us_, room_, session);
  }
  out_.Send(to, datagram);
}

std::int64_t RoomNet::discarded() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return lost_;
}

}  // namespace seam
