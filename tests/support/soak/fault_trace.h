#pragma once
/// Prints the events of a session's clients, to find the cause of a failing seed.

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/support/soak/fault_runner.h"

namespace seam {

class FaultTrace {
 public:
  explicit FaultTrace(const FaultPlan& plan) {
    for (const Fault& fault : plan.faults) {
      std::printf("  client %d %s from %.3f to %.3f s\n", fault.client, ToString(fault.kind),
                  fault.from_s, fault.to_s);
    }
    // SEAM_SOAK_WATCH=body:from_s:to_s prints where each peer has that body, tick by tick.
    const char* const watch = std::getenv("SEAM_SOAK_WATCH");
    if (watch != nullptr) std::sscanf(watch, "%d:%lf:%lf", &body_, &from_s_, &to_s_);
  }

  /// Prints changes: clients that are in, play, or join again. To be called after every virtual
  /// instant.
  void Look(Cluster& cluster) {
    seen_.resize(static_cast<std::size_t>(cluster.client_count()));
    for (int c = 0; c < cluster.client_count(); ++c) {
      const Client* client = cluster.client(c);
      std::string now = "gone";
      if (client != nullptr) {
        now = client->running() ? "plays" : client->peer() >= 0 ? "is in" : "knocks";
        now += ", joined again " + std::to_string(client->rejoins()) + " times";
      }
      std::string& seen = seen_[static_cast<std::size_t>(c)];
      if (seen == now) continue;
      std::printf("  %.3f s: client %d %s\n",
                  static_cast<double>(cluster.server().tick()) / cluster.scene().solver.tick_hz, c,
                  now.c_str());
      seen = now;
    }
    const std::int64_t tick = cluster.server().tick();
    const double at_s = static_cast<double>(tick) / cluster.scene().solver.tick_hz;
    if (tick == watched_ || at_s < from_s_ || at_s > to_s_) return;
    watched_ = tick;
    Watch(cluster.server().replica(), 0, at_s);
    for (int c = 0; c < cluster.client_count(); ++c) {
      const Client* client = cluster.client(c);
      const bool runs = client != nullptr && client->running() && client->replica() != nullptr;
      if (runs) Watch(*client->replica(), client->peer(), at_s);
    }
  }

 private:
  void Watch(const Replica& replica, int peer, double at_s) const {
    const World& world = replica.world();
    const int body = world.BodyOfId(static_cast<PartId>(body_));
    if (body < 0) return;
    const BodyState state = world.Read(body);
    const AuthorityTable& table = replica.authority();
    const int mechanism = world.mechanism(body);
    std::printf("  %.3f s, peer %d at tick %lld: body %d at %.3f %.3f %.3f, %.2f %.2f m/s, %.2f",
                at_s, peer, static_cast<long long>(world.tick()), body_, double{state.position.x()},
                double{state.position.y()}, double{state.angle}, double{state.velocity.x()},
                double{state.velocity.y()}, double{state.spin});
    std::printf(" rad/s; of peer %d in epoch %d, motion %d\n", table.at(mechanism).authority,
                table.at(mechanism).epoch, static_cast<int>(world.activity(body)));
  }

  int body_ = -1;
  double from_s_ = 1, to_s_ = 0;
  std::int64_t watched_ = -1;
  std::vector<std::string> seen_;
};

}  // namespace seam
