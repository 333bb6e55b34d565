#pragma once
/// A room of a server that has several, or one: a Server with its end of the socket, its simulated
/// network and its recording, run when it is due and measured.

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "common/net/impair.h"
#include "common/record/load_page.h"
#include "common/record/sink.h"
#include "common/sync/publisher.h"
#include "server/hub/lanes.h"
#include "server/hub/room_net.h"
#include "server/load/load_watch.h"
#include "server/tick_times.h"

namespace seam {

/// What a room is made of.
struct RoomPlan {
  Scene scene;
  ServerConfig config;         ///< with its name
  ImpairProfile profile;       ///< of its simulated network, both ways
  std::int64_t last_tick = 0;  ///< it is done after this tick; 0: never
  std::string lcm_url = "none";
  std::string record;  ///< path of its log; "": none
  bool force = false;
  bool alone = true;  ///< the only room of the program: it tells the program's CPU time
  bool news = true;   ///< who comes and goes is told
};

class HostedRoom : public Runnable {
 public:
  /// `finder` and `out` must outlive it; it only sends by `out`, which nobody else uses. `index`:
  /// the finder's. Throws OperatorError for a log or a bus that is not to be had.
  HostedRoom(const RoomPlan& plan, int index, RoomFinder& finder, Net& out);

  /// Runs the server once. After its last tick the clients are told goodbye, and nothing more is
  /// done than to let that through.
  void Run(std::int64_t now_us) override;
  std::int64_t due_us() const override;

  /// By any thread: a datagram for it.
  void Deliver(const Address& from, Bytes datagram) { net_.Deliver(from, std::move(datagram)); }
  /// By any thread: the last Load that it told, with utime 0 before the first, and the histograms
  /// up to its last tick.
  RoomLoad newest() const;
  /// By any thread: the tick after which it was to end is done.
  bool done() const;
  /// By any thread: what the operator should read since the last call, a line each: warnings, and
  /// who came and went.
  std::vector<std::string> TakeNews();

  // Not while a thread runs it:
  /// Says goodbye to its clients, unless it is done, and closes its recording.
  void Close(std::int64_t now_us);
  /// Lets what was sent through the simulated network; false when nothing is under way any more.
  bool LetThrough(std::int64_t now_us);
  const Server& server() const { return server_; }
  const Scene& scene() const { return plan_.scene; }
  const ServerConfig& config() const { return plan_.config; }
  const Sink& sink() const { return sink_; }
  std::int64_t last_tick() const { return plan_.last_tick; }
  const TickTimes& tick_times() const { return tick_times_; }

 private:
  std::int64_t CpuForStats(std::int64_t now_us) const;
  void NoteTicks();
  void Tell(std::int64_t now_us);
  void CollectNews();
  void EndIfDone(std::int64_t now_us);

  const RoomPlan plan_;
  RoomNet net_;
  ImpairedNet impaired_;
  Sink sink_;
  OsEntropy entropy_;
  Publisher publisher_;  // of its Loads
  Server server_;
  LoadWatch watch_;
  TickTimes tick_times_;
  std::int64_t ran_us_ = 0;
  bool trouble_said_ = false;
  mutable std::mutex mutex_;  // of all below
  RoomLoad newest_;
  bool done_ = false;
  std::vector<std::string> news_;
};

}  // namespace seam
