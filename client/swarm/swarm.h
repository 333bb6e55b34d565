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
  /// order. Throws OperatorError when a room does not answer within 10 s, refuses, or has fewer
  /// players than clients would come. Nobody has joined then.
  explicit Swarm(const SwarmConfig& config);
  ~Swarm();

  /// Starts the threads; the clients join.
  void Start();
  /// Clients that simulate.
  int running() const;
  /// The first client's misfortune that ends it all; "": none. Final.
  std::string Fatal() const;
  bool closed() const { return closed_; }
  /// Forgets what joining took: from here on counts what the report says.
  void BeginToMeasure(std::int64_t now_us);
  /// All say goodbye and the threads end; then figures() and the others may be read.
  void Finish(std::int64_t now_us);

  /// How long it was measured, s.
  double measured_s() const { return measured_s_; }
  MemberFigures Figures() const;
  /// On average over the samples, two a second.
  MovingBodies Moving() const;
  /// Of each client: what it has sent and received since BeginToMeasure, and its loss and round
  /// trip at the end.
  struct Traffic {
    double bytes_in = 0, bytes_out = 0;      ///< of all clients together
    double loss_mean = 0, loss_worst = 0;    ///< shares, of what comes in
    double rtt_mean_s = 0, rtt_worst_s = 0;  ///< s
    double load_mean = 0, load_worst = 0;    ///< shares of its time that a client says it needs
    std::int64_t rejoins = 0;
  };
  Traffic TrafficOfAll() const;
  /// CPU time of this program while it was measured, s.
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

/// The room that a server would show a player, asked for by a spectator who leaves again at once.
/// Throws OperatorError when there is no answer within 10 s, or a refusal.
Room AskForRoom(const Address& server, const std::string& room);

}  // namespace seam
