#pragma once
/// One room of a server program: a Server with its end of the socket, its simulated network and its
/// recording. Runs when due, and measures its load.

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/net/impair.h"
#include "common/record/load_page.h"
#include "common/record/sink.h"
#include "common/record/store/session_writer.h"
#include "server/control/room_control.h"
#include "server/hub/lanes.h"
#include "server/hub/lcm_bridge.h"
#include "server/hub/room_net.h"
#include "server/load/load_watch.h"
#include "server/saved/resumed_room.h"
#include "server/saved/room_keeper.h"

namespace seam {

/// Configuration of a room.
struct RoomPlan {
  Scene scene;
  ServerConfig config;         ///< includes the room's name
  ImpairProfile profile;       ///< of its simulated network, both directions
  std::int64_t last_tick = 0;  ///< the room ends after this tick; 0: never
  std::string lcm_url = "none";
  std::string record;  ///< path of its log; "": none
  std::shared_ptr<const Secret> log_key;  ///< of the log; null: none
  bool force = false;
  std::string state;  ///< folder in which the room is kept, with its log; "": none
  std::int64_t segment_bytes = 0;              ///< of its log, see RoomLog
  std::int64_t keep_s = 0;                     ///< of its log, see RoomKeeper
  std::shared_ptr<const ResumedRoom> resumed;  ///< the room to go on with; null: it begins
  std::vector<std::shared_ptr<SessionWriter>> writers;  ///< that the sessions are put into
  bool control = false;  ///< an operator may change it: its network is always a simulated one
  bool alone = true;  ///< only room of the program: reports the program's CPU time
  bool news = true;   ///< reports players that come and go
};

class HostedRoom : public Runnable {
 public:
  /// `finder` and `out` must outlive it; `out` is used for sending only, and by this room only.
  /// `index` is the room's index in the finder. Throws OperatorError if the log or the bus cannot
  /// be opened.
  HostedRoom(const RoomPlan& plan, int index, RoomFinder& finder, Net& out);

  /// Runs the server once. After the last tick says goodbye to the clients, and from then on only
  /// flushes the simulated network.
  void Run(std::int64_t now_us) override;
  std::int64_t due_us() const override;

  /// Thread-safe: queues a datagram for the room.
  void Deliver(const Address& from, Bytes datagram) { net_.Deliver(from, std::move(datagram)); }
  /// Thread-safe: returns the last published Load, with utime 0 before the first, and the
  /// histograms up to the last tick.
  RoomLoad newest() const;
  /// Thread-safe: the time of the last Run.
  std::int64_t ran_us() const { return ran_us_; }
  /// Thread-safe: true after the last tick of a room with an end.
  bool done() const;
  /// Thread-safe: returns the lines for the operator since the last call: warnings, and players
  /// that came and went.
  std::vector<std::string> TakeReports();

  /// Thread-safe: the room goes on at another server in this epoch: stops it without a word to its
  /// clients, or, with an address in `elsewhere`, sends them there. Its files stay as they are.
  void Supersede(const Redirect& elsewhere);
  /// Thread-safe: see Server::NameStandby.
  void NameStandby(const std::string& address);
  /// Thread-safe: true if another server has the room.
  bool over() const;

  // Only while no thread runs the room:
  /// Does a command of the operator; see RoomControl. Requires RoomPlan::control.
  Status Control(std::int64_t now_us, const std::string& command);
  std::string ControlJson() const { return control_->Json(); }
  /// Saves the room for another server, which is to go on with it in the next epoch; it stops.
  /// Returns that epoch. Redirect or Supersede follows.
  std::int32_t GiveAway(std::int64_t now_us);
  /// Says goodbye to the clients instead: nobody goes on with it now.
  void EndGivenAway(std::int64_t now_us);
  /// Sends the clients to the server that goes on with the room.
  void RedirectAll(std::int64_t now_us, const Redirect& to);
  /// Says goodbye to the clients, unless done, and closes the recording.
  void Close(std::int64_t now_us);
  /// Advances the simulated network; false if nothing is in flight any more.
  bool DrainNetwork(std::int64_t now_us);
  const Server& server() const { return *server_; }
  const Scene& scene() const { return plan_.scene; }
  const ServerConfig& config() const { return plan_.config; }
  const Sink& sink() const { return sink_; }
  /// Returns the first failure to write the log, a snapshot, the store or events.
  Status trouble() const;
  /// The room's snapshots; nullptr if it is not kept.
  const RoomKeeper* keeper() const { return keeper_.get(); }
  std::int64_t last_tick() const { return plan_.last_tick; }
  /// Returns the sums of the sessions that have ended here: of one that was killed before, then
  /// this.
  const std::vector<Summary>& summaries() const { return summaries_; }
  /// Returns the wall time of all ticks so far.
  const DurationHistogram& tick_times() const { return watch_.session(); }

 private:
  std::int64_t CpuForStats(std::int64_t now_us) const;
  void NoteTicks();
  /// The same for a room that has gone on elsewhere: only answers.
  void RunOver(std::int64_t now_us);
  void Tell(std::int64_t now_us);
  void CollectReports();
  /// Stops if another server has the room; names the standby.
  void FollowDirectory(std::int64_t now_us);
  void EndIfDone(std::int64_t now_us);
  void OpenLcm();
  void GoOn(const ResumedRoom& resumed);
  void TakeSummaries();
  void Put(const Summary& summary, std::vector<Event> events);

  const RoomPlan plan_;
  RoomNet net_;
  ImpairedNet impaired_;
  Sink sink_;
  OsEntropy entropy_;
  std::unique_ptr<Server> server_;
  std::unique_ptr<RoomControl> control_;  // null: nobody changes it
  std::unique_ptr<LcmBridge> lcm_;        // null: the scene has no [lcm], or there is no bus
  std::unique_ptr<RoomKeeper> keeper_;    // null: the room is not kept
  LoadWatch watch_;
  std::atomic<std::int64_t> ran_us_{0};
  bool trouble_reported_ = false;
  std::vector<Summary> summaries_;
  mutable std::mutex mutex_;  // guards all below
  RoomLoad newest_;
  bool done_ = false;
  bool over_ = false;
  std::optional<Redirect> superseded_;  // not acted on yet
  std::string standby_;                 // not told yet
  std::vector<std::string> news_;
};

}  // namespace seam
