#pragma once
/// The real Server and Clients in one process, over the simulated network, in virtual time.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "client/client.h"
#include "common/net/impair.h"
#include "common/net/memory.h"
#include "common/record/recording.h"
#include "server/room_state.h"
#include "server/saved/log_tail.h"
#include "server/server.h"

namespace seam {

struct ClusterConfig {
  std::string scene = "crossing";  ///< name in scenes/
  std::string scene_text;          ///< instead of a file, if not empty
  std::string mode = "buffer";
  std::string reconcile;
  std::string predict;
  std::string impair = "demo";
  double client_bytes_per_s = kClientBytesPerS;  ///< see ServerConfig
  std::int64_t seed = 1;
  double duration_s = 0;  ///< ticks after tick 0; 0: the scene's own
  int spectators = 0;     ///< clients besides the scene's players, after them: "guest0", ...
  Drive drive = Drive::kScript;
  Publish publish = Publish::kAll;  ///< for server and clients
  bool shows = false;               ///< clients display their views: see ClientConfig
  int players = 0;                  ///< the first so many of the scene's join; 0: all
  int send_hz = 30;
  float smooth_rate = kSmoothRate;
  TrustMode trust = TrustMode::kAct;  ///< of the server
  std::optional<int> show_age_ticks;  ///< of all clients; nullopt: the scene's
  Recorder* recorder = nullptr;       ///< also gets every message, at now_us()
  /// Duration of a server tick, us of virtual time, by tick; nullptr: 0.
  std::function<std::int64_t(std::int64_t)> server_tick_us;
  /// CPU time of a client for each body in each of its steps, replayed ones included, us. Virtual
  /// time has no CPU: this is a model. 0: clients take no time and do not know their load.
  double client_body_us = 0;
  std::vector<double> client_throttle;  ///< by client: times slower; beyond the end 1
  bool keep = true;                     ///< recording() has everything; false saves its memory
  /// If set, makes the replacement of each client's network (by the scene's order of players).
  std::function<std::unique_ptr<Net>(std::size_t, std::unique_ptr<Net>)> client_net;
};

class Cluster {
 public:
  /// Throws OperatorError for a scene that does not load, and for unknown names.
  explicit Cluster(const ClusterConfig& config);
  /// Like above, with the scene instead of its name or text.
  Cluster(const ClusterConfig& config, const Scene& scene);
  ~Cluster();

  /// Runs until the server has done this many ticks. Throws OperatorError after 30 s without a
  /// tick: the network is too bad to play.
  void RunToTick(std::int64_t tick);
  /// Runs to the configured end.
  void Run();

  /// Total CPU time of the server so far, us, on this machine, network included.
  double server_cpu_us() const { return server_cpu_us_; }
  /// Total CPU time of all clients together, us.
  double client_cpu_us() const { return client_cpu_us_; }
  /// Sums over all peers: ticks that were stepped again, and replays that waited for their budget.
  std::int64_t ticks_stepped_again();
  std::int64_t replays_deferred();

  /// Called after every virtual instant.
  std::function<void()> each_instant;

  /// Kills the client's process (nothing more is sent), or starts a new one with its name and key.
  void Kill(int client);
  void Revive(int client);
  /// Lets the client say goodbye and end; Revive lets it come back.
  void Leave(int client);
  /// Ends the server without a word. Another one goes on with the saved room and the end of its
  /// log, at the same address, `down_us` later. Throws OperatorError if it cannot.
  void RestartServer(const SavedRoom& saved, const LogTail& tail, std::int64_t down_us);
  /// Stops the client's process, or lets it go on.
  void Pause(int client, bool paused) {
    clients_[static_cast<std::size_t>(client)].paused = paused;
  }

  Server& server() { return *server_; }
  const Server& server() const { return *server_; }
  Client* client(int i) { return clients_[static_cast<std::size_t>(i)].client.get(); }
  const Client* client(int i) const { return clients_[static_cast<std::size_t>(i)].client.get(); }
  /// Returns the key that a revived client would use.
  std::int64_t key(int i) const { return clients_[static_cast<std::size_t>(i)].key; }
  int client_count() const { return static_cast<int>(clients_.size()); }
  std::int64_t now_us() const { return now_us_; }
  const Recording& recording();
  ImpairedNet& server_net() { return *server_net_; }
  const Scene& scene() const { return scene_; }
  /// Makes a raw endpoint of the network, for hostile tests.
  std::unique_ptr<Net> Attach(const Address& address) { return network_.Attach(address); }
  Address server_address() const { return server_address_; }

 private:
  /// Records the peers' messages to memory and to the configured recorder, with the virtual time,
  /// as lcm-logger does in a live session.
  class Tap : public Recorder {
   public:
    explicit Tap(const Cluster& cluster) : cluster_(cluster) {}
    void Publish(const std::string& channel, std::int64_t utime, ByteView message) override;
    void EndTick(const std::string& channel, const LogSeal& seal, bool kept) override;
    bool listening() const override {
      return cluster_.config_.keep || cluster_.config_.recorder != nullptr;
    }
    MemoryRecorder memory;

   private:
    const Cluster& cluster_;
  };
  struct Peer {
    std::unique_ptr<Net> endpoint;
    std::unique_ptr<Entropy> entropy;
    std::unique_ptr<Client> client;
    std::int64_t clock_offset_us = 0;
    std::int64_t key = 0;  // the content of seam-client's --key file
    bool paused = false;
    double cpu_us = 0;  // modelled
    std::int64_t busy_until_us = 0;
    std::int64_t replayed = 0;  // ticks, as of its last call
  };
  void TickClient(std::size_t i);
  void StartClient(std::size_t i);
  void Instant();
  /// Runs the server, unless it is still at its last ticks.
  void RunServer();
  /// Sums a count over the existing replicas of server and clients.
  std::int64_t Sum(std::int64_t (Replica::*count)() const);

  ClusterConfig config_;
  Scene scene_;
  MemoryNetwork network_;
  std::int64_t now_us_ = 1000000;
  Tap recorder_{*this};
  Address server_address_{0x7f000001, 7777};
  std::unique_ptr<Net> server_endpoint_;
  std::unique_ptr<ImpairedNet> server_net_;
  std::unique_ptr<Entropy> server_entropy_;
  ServerConfig server_config_;
  std::unique_ptr<Server> server_;
  std::uint64_t server_restarts_ = 0;
  std::vector<Peer> clients_;
  std::uint16_t next_port_ = 20000;
  double server_cpu_us_ = 0, client_cpu_us_ = 0;
  std::int64_t server_busy_until_us_ = 0;
};

/// Returns the number of bodies in a world's steps: all but the absent ones.
int SteppedBodies(const World& world);

/// Runs a cluster to its end and returns its recording.
Recording RunCluster(const ClusterConfig& config);

}  // namespace seam
