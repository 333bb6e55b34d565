#pragma once
/// A load test: many Clients against one server, in a few threads, from joining to goodbye.

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "client/swarm/group.h"

namespace seam {

struct SwarmConfig {
  Address server;
  int clients = 1;
  Drive drive = Drive::kBot;
  std::vector<std::string> rooms = {""};  ///< client i joins room i % rooms; "": the first
  int threads = 1;
};

class Swarm {
 public:
  /// Asks each room for its players: client i is player i / rooms of its room, in the scene's
  /// order. Throws OperatorError if a room does not answer within 10 s, refuses, or has fewer
  /// players than clients would come. No client has joined then.
  explicit Swarm(const SwarmConfig& config);
  ~Swarm();

  /// Starts the threads; the clients join.
  void Start();
  /// Returns the number of clients that simulate.
  int running() const;
  /// Returns the first client's fatal error; "": none. Final.
  std::string Fatal() const;
  bool closed() const { return closed_; }
  /// Restarts the measurements: the report covers the time from here on.
  void BeginToMeasure(std::int64_t now_us);
  /// Says goodbye for all clients and ends the threads; then Figures() and all below may be read.
  void Finish(std::int64_t now_us);

  /// Duration of the measurement, s.
  double measured_s() const { return measured_s_; }
  MemberFigures Figures() const;
  /// Average over the samples, two a second.
  MovingBodies Moving() const;
  /// Traffic of the clients since BeginToMeasure, and their loss and round trip at the end.
  struct Traffic {
    double bytes_in = 0, bytes_out = 0;      ///< sum of all clients
    double loss_mean = 0, loss_worst = 0;    ///< shares of received packets
    double rtt_mean_s = 0, rtt_worst_s = 0;  ///< s
    double load_mean = 0, load_worst = 0;    ///< shares of its time that a client reports as needed
    std::int64_t rejoins = 0;
  };
  Traffic TrafficOfAll() const;
  /// CPU time of this program during the measurement, s.
  double cpu_s() const { return cpu_s_; }
  const Room& room() const { return room_; }
  int client_count() const { return config_.clients; }
  int room_count() const { return static_cast<int>(config_.rooms.size()); }

 private:
  struct Lane;  // a thread and its group
  void Run(Lane* lane);
  void Look(Lane* lane);

  SwarmConfig config_;
  std::vector<std::unique_ptr<Lane>> lanes_;
  Room room_;  // the first room's
  std::atomic<bool> stop_{false}, measure_{false}, closed_{false};
  mutable std::mutex mutex_;
  std::string fatal_;
  std::int64_t measured_since_us_ = 0;
  std::int64_t cpu_before_us_ = 0;
  double measured_s_ = 0, cpu_s_ = 0;
};

/// Returns the room that a server shows a player, found by a spectator that leaves again at once.
/// Throws OperatorError if there is no answer within 10 s, or a refusal.
Room AskForRoom(const Address& server, const std::string& room);

}  // namespace seam
