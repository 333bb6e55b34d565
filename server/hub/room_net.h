#pragma once
/// A room's end of the socket that all rooms share: what the hub has sorted out for it comes in,
/// what it sends goes out by a sender of its own, and both are counted.

#include <cstdint>
#include <deque>
#include <mutex>
#include <set>
#include <utility>

#include "common/net/net.h"
#include "server/hub/room_finder.h"
#include "server/load/traffic_count.h"

namespace seam {

class RoomNet : public Net {
 public:
  /// `finder` and `out` must outlive it; it only sends by `out`.
  RoomNet(RoomFinder& finder, int room, Net& out) : finder_(finder), room_(room), out_(out) {}

  /// By the hub's thread: a datagram for this room. Beyond kInboxMax it is lost, and counted.
  void Deliver(const Address& from, Bytes datagram);
  /// By any thread: something waits that was not taken yet.
  bool HasMail() const;

  // By the room's thread alone.
  void Advance(std::int64_t now_us) override;
  void Send(const Address& to, ByteView datagram) override;
  void Flush() override { out_.Flush(); }
  bool Receive(Address* from, Bytes* datagram) override;
  std::int64_t discarded() const override;
  const TrafficCount& traffic() const { return traffic_; }

  /// Datagrams that may wait: a room that stands still for long must not take all memory.
  static constexpr std::size_t kInboxMax = 8192;

 private:
  using Datagrams = std::deque<std::pair<Address, Bytes>>;

  RoomFinder& finder_;
  const int room_;
  Net& out_;
  mutable std::mutex mutex_;  // of inbox_ and lost_
  Datagrams inbox_;
  std::int64_t lost_ = 0;
  Datagrams taken_;
  std::int64_t now_us_ = 0;
  std::set<std::pair<Address, std::uint64_t>> learned_;  // sessions the finder was told of
  TrafficCount traffic_;
};

}  // namespace seam
