#pragma once
/// A room of real players with relays and their watchers, in virtual time.

#include <time.h>

#include <memory>
#include <string>
#include <vector>

#include "client/embed/cluster.h"
#include "common/net/impair.h"
#include "server/relay/relay.h"

namespace seam {

/// CPU time of this thread, us.
inline double ThreadCpuUs() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e6 + static_cast<double>(t.tv_nsec) * 1e-3;
}

class RelayedRoom {
 public:
  struct Silence : Recorder {
    void Publish(const std::string&, std::int64_t, ByteView) override {}
    bool listening() const override { return false; }
  };
  /// A relay with its two endpoints. Its clock is its own.
  struct Spot {
    Address address;
    std::unique_ptr<Net> up, down;
    std::unique_ptr<ImpairedNet> path;  // to the watchers
    std::unique_ptr<SeededEntropy> entropy;
    std::unique_ptr<Relay> relay;
    std::int64_t clock_us = 0;
    double cpu_us = 0;
  };
  /// A real client.
  struct Seat {
    std::unique_ptr<Net> net;
    std::unique_ptr<SeededEntropy> entropy;
    std::unique_ptr<Client> client;
    std::int64_t clock_us = 0;
  };

  /// `impair`: also between relays and watchers. The server has `config.spectators` watchers.
  explicit RelayedRoom(const ClusterConfig& config)
      : cluster(config), profile_(FindProfile(config.impair)), seed_(config.seed) {
    cluster.each_instant = [this] { Instant(); };
  }

  /// Adds a relay of the server, or of `server`.
  Spot& AddRelay(RelayConfig config = {}, const Address* server = nullptr) {
    spots.push_back(std::make_unique<Spot>());
    Spot& spot = *spots.back();
    const auto n = static_cast<std::uint32_t>(spots.size());
    spot.address = Address{0x0b000000 + n, 7778};
    spot.up = cluster.Attach(Address{0x0b000000 + n, 9000});
    spot.down = cluster.Attach(spot.address);
    spot.path = std::make_unique<ImpairedNet>(*spot.down, profile_, profile_,
                                              static_cast<std::uint64_t>(100 * seed_ + n));
    spot.entropy =
        std::make_unique<SeededEntropy>(9000 + 10 * static_cast<std::uint64_t>(seed_) + n);
    spot.clock_us = 5000000000 + 77777777 * static_cast<std::int64_t>(n);
    config.upstream.server = server != nullptr ? *server : cluster.server_address();
    config.upstream.name = "relay" + std::to_string(n);
    if (config.limits.watchers == 0) config.limits.watchers = 2000;
    spot.relay = std::make_unique<Relay>(config, *spot.up, *spot.path, *spot.entropy);
    return spot;
  }
  /// Adds a real client that joins at `server`.
  Seat& AddClient(const Address& server, const std::string& name, bool watch = true,
                  ClientTap* tap = nullptr) {
    seats.push_back(std::make_unique<Seat>());
    Seat& seat = *seats.back();
    const auto n = static_cast<std::uint32_t>(seats.size());
    seat.net = cluster.Attach(Address{0x0c000000 + n, 9000});
    seat.entropy = std::make_unique<SeededEntropy>(777000 + n);
    seat.clock_us = 123456789 + 11111111 * static_cast<std::int64_t>(n);
    ClientConfig config;
    config.server = server;
    config.name = name;
    config.watch = watch;
    config.shows = true;
    config.tap = tap;
    seat.client = std::make_unique<Client>(config, *seat.net, silence_, *seat.entropy);
    return seat;
  }
  void Run(std::int64_t ticks) { cluster.RunToTick(cluster.server().tick() + ticks); }

  Cluster cluster;
  std::vector<std::unique_ptr<Spot>> spots;
  std::vector<std::unique_ptr<Seat>> seats;
  /// Called after every virtual instant.
  std::function<void()> each_instant;

 private:
  void Instant() {
    for (const auto& spot : spots) {
      if (spot->relay == nullptr) continue;
      const double begin_us = ThreadCpuUs();
      spot->relay->Tick(cluster.now_us() + spot->clock_us);
      spot->cpu_us += ThreadCpuUs() - begin_us;
    }
    for (const auto& seat : seats) {
      if (seat->client != nullptr) seat->client->Tick(cluster.now_us() + seat->clock_us, 0);
    }
    if (each_instant) each_instant();
  }

  const ImpairProfile profile_;
  const std::int64_t seed_;
  Silence silence_;
};

}  // namespace seam
