#pragma once
/// Several rooms behind one socket: the hub takes datagrams from it, finds the room of each, and
/// lets worker threads run the rooms.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/net/http_page.h"
#include "common/net/udp.h"
#include "server/hub/gather.h"
#include "server/hub/hosted_room.h"
#include "server/hub/lanes.h"
#include "server/hub/room_finder.h"
#include "server/sessions/handshake.h"

namespace seam {

class Hub {
 public:
  /// Opens the rooms; `udp` must outlive it. Their names must differ (asserted). Throws
  /// OperatorError as HostedRoom does.
  Hub(const std::vector<RoomPlan>& plans, UdpNet& udp);
  ~Hub();
  Hub(const Hub&) = delete;
  Hub& operator=(const Hub&) = delete;

  /// Starts `workers` threads that run the rooms. Without, Poll runs them.
  void Start(int workers);
  /// Hands out what has come; without workers runs the rooms that are due. To be called whenever
  /// Wait returns. Never waits.
  void Poll(std::int64_t now_us);
  /// Until a datagram comes (a few ms later where they come in a row: Gather) or a room is due; at
  /// most 20 ms.
  void Wait();
  /// Each room has done its last tick.
  bool done() const;
  /// Ends the threads, says goodbye to all, and lets that through the simulated networks.
  void Close();

  const std::vector<std::unique_ptr<HostedRoom>>& rooms() const { return rooms_; }
  /// The newest Load of each room that has told one.
  std::vector<RoomLoad> Loads() const;
  /// Of all rooms, a line each.
  std::vector<std::string> TakeNews();
  /// Datagrams that were for no room.
  std::int64_t strangers() const { return strangers_; }
  /// Threads that run rooms; 0 without workers.
  int lane_count() const { return lanes_ == nullptr ? 0 : lanes_->lane_count(); }

 private:
  void Take(std::int64_t now_us);

  UdpNet& udp_;
  RoomFinder finder_;
  OsEntropy entropy_;
  Handshake handshake_;  // answers a Hello to several rooms, and who asks for an unknown one
  std::vector<std::unique_ptr<UdpSender>> senders_;
  std::vector<std::unique_ptr<HostedRoom>> rooms_;
  std::vector<bool> mail_;  // by room, in one Take
  std::int64_t strangers_ = 0;
  Gather gather_;
  std::unique_ptr<Lanes> lanes_;
};

}  // namespace seam
