#pragma once
/// Several rooms behind one socket: takes datagrams from it, finds the room of each, and lets
/// worker threads run the rooms.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
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
  /// Opens the rooms, none or more; `udp` must outlive the hub, whose lasting keys `identity` is.
  /// Asserts that the names differ. Throws OperatorError as HostedRoom does.
  /// `token_key`: of the operator's connect tokens, for joins to rooms that are elsewhere.
  Hub(const std::vector<RoomPlan>& plans, UdpNet& udp, std::shared_ptr<const KeyPair> identity,
      std::shared_ptr<const Secret> token_key = nullptr);
  ~Hub();
  Hub(const Hub&) = delete;
  Hub& operator=(const Hub&) = delete;

  /// Starts `workers` threads that run the rooms. Without threads, Poll runs the rooms.
  void Start(int workers);
  /// Opens one more room, in place of one of the same name. Throws OperatorError as HostedRoom
  /// does.
  void Add(const RoomPlan& plan);
  /// Finds the server that has the room of a join, which is not here, or no more; it is asked for
  /// those that have proved their address. With an empty address the join gets no answer: the room
  /// may come here, and the client asks again. nullopt, or without this: the join is refused.
  using Elsewhere = std::function<std::optional<Redirect>(const JoinRequest& join)>;
  void SetElsewhere(Elsewhere elsewhere) { elsewhere_ = std::move(elsewhere); }
  /// Gives the rooms to other servers; each runs here until it is its turn, so that it never looks
  /// dead. `may_be_taken`: called again and again; others may take rooms (HostedRoom::Supersede)
  /// until it returns false, or all are over. The rest is saved, one after another; `where`:
  /// returns where the saved room goes on in this epoch or a higher one, or an empty address if
  /// nowhere. Sends the clients there, and serves until they know it, for at most kDrainUsMax. Ends
  /// the threads.
  using Where = std::function<Redirect(const std::string& room, std::int32_t epoch)>;
  void Drain(const std::function<bool()>& may_be_taken, const Where& where);
  /// Delivers the received datagrams; without workers also runs the rooms that are due. To be
  /// called whenever Wait returns. Never blocks.
  void Poll(std::int64_t now_us);
  /// Waits until a datagram comes (later while they come in a row: Gather) or a room is due;
  /// at most 20 ms.
  void Wait();
  /// True if every room has done its last tick.
  bool done() const;
  /// True if every room that is not done has run at this time or later: none hangs.
  bool AllRan(std::int64_t since_us) const;
  /// Ends the threads, says goodbye to all clients, and flushes the simulated networks.
  void Close();

  const std::vector<std::unique_ptr<HostedRoom>>& rooms() const { return rooms_; }
  /// Returns the newest Load of each room that has published one.
  std::vector<RoomLoad> Loads() const;
  /// Returns the lines for the operator of all rooms.
  std::vector<std::string> TakeReports();
  /// Datagrams that belong to no room.
  std::int64_t strangers() const { return strangers_; }
  /// Threads that run rooms now; 0 without workers.
  int lane_count() const { return lanes_ == nullptr ? 0 : lanes_->lane_count(); }

 private:
  void Take(std::int64_t now_us);
  /// Saves the room and sends its clients on, if it goes on anywhere. No thread may run it.
  static void GiveAway(HostedRoom& room, const Where& where);
  /// True for a join to a room that goes on at another server.
  bool AsksForOver(int room, const Bytes& datagram) const;
  void OnUnknownRoom(std::int64_t now_us, const Address& from, std::uint64_t number,
                     const Bytes& datagram);
  /// Keeps a join to a room that may come here, in place of an earlier one of the same sender.
  void Keep(std::int64_t now_us, const Address& from, const std::string& room,
            const Bytes& datagram);
  /// Gives a room that has come the joins that waited for it.
  void DeliverKept(std::int64_t now_us, int room);

  UdpNet& udp_;
  RoomFinder finder_;
  OsEntropy entropy_;
  const std::shared_ptr<const KeyPair> identity_;
  TrafficCount traffic_;
  Handshake handshake_;  // answers a Hello to several rooms, and refuses unknown ones
  std::vector<std::unique_ptr<UdpSender>> senders_;
  std::vector<std::unique_ptr<HostedRoom>> rooms_;
  std::vector<bool> mail_;  // by room: got a datagram in this Take
  std::int64_t strangers_ = 0;
  Elsewhere elsewhere_;
  bool drains_ = false;
  struct WaitingJoin {
    Address from;
    std::string room;
    Bytes datagram;
    std::int64_t at_us = 0;
  };
  std::vector<WaitingJoin> waiting_;  // the oldest first
  Gather wake_policy_;
  std::unique_ptr<Lanes> lanes_;
};

}  // namespace seam
