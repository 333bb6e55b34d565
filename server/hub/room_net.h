#pragma once
/// A room's end of the shared socket: receives the datagrams that the hub delivers, and sends by a
/// sender of its own.

#include <cstdint>
#include <deque>
#include <mutex>
#include <set>
#include <utility>

#include "common/net/net.h"
#include "server/hub/room_finder.h"

namespace seam {

class RoomNet : public Net {
 public:
  /// `finder` and `out` must outlive it; `out` is used for sending only.
  RoomNet(RoomFinder& finder, int room, Net& out) : finder_(finder), room_(room), out_(out) {}

  /// Called by the hub's thread: queues a datagram for this room. Drops and counts it if kInboxMax
  /// are queued.
  void Deliver(const Address& from, Bytes datagram);
  /// Thread-safe: true if a datagram is queued.
  bool HasMail() const;

  // Called by the room's thread alone.
  void Advance(std::int64_t now_us) override;
  void Send(const Address& to, ByteView datagram) override;
  void Flush() override { out_.Flush(); }
  bool Receive(Address* from, Bytes* datagram) override;
  std::int64_t discarded() const override;

  /// Most queued datagrams, so that a room that is stuck does not use all memory.
  static constexpr std::size_t kInboxMax = 8192;

 private:
  using Datagrams = std::deque<std::pair<Address, Bytes>>;

  RoomFinder& finder_;
  const int room_;
  Net& out_;
  mutable std::mutex mutex_;  // guards inbox_ and lost_
  Datagrams inbox_;
  std::int64_t lost_ = 0;
  Datagrams taken_;
  std::int64_t now_us_ = 0;
  std::set<std::uint64_t> learned_;  // sessions known to the finder
};

}  // namespace seam
