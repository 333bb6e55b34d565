#pragma once
/// Prints what happens to a session's clients, for whoever looks for the cause of a failing seed.

#include <cstdio>
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
  }

  /// After every virtual instant: who is in, plays, or joins again.
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
  }

 private:
  std::vector<std::string> seen_;
};

}  // namespace seam
