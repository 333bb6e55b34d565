#pragma once
/// Applies a plan's faults to a cluster's clients, at the room's time.

#include <functional>
#include <memory>
#include <vector>

#include "tests/support/soak/fault_plan.h"

namespace seam {

class MovableNet;

class FaultRunner {
 public:
  /// `plan` must outlive this, and this the cluster made of `Config()`.
  explicit FaultRunner(const FaultPlan& plan);

  /// Returns the plan's configuration, with networks that can be cut.
  ClusterConfig Config();
  /// Begins and ends faults that are due. To be called after every virtual instant.
  void Act(Cluster& cluster);

  /// Kills the server and lets another go on after some us; false: it cannot be killed yet.
  std::function<bool(Cluster& cluster, std::int64_t down_us)> restart_server;

  /// True if the client's process does not run, or there is none, or its session is one of a server
  /// that has died.
  bool Stopped(int client) const { return at(client).stopped || at(client).lost_session >= 0; }
  /// Time since which the client has no fault, us of virtual time; -1: it has one.
  std::int64_t WellSince(int client) const { return at(client).well_since_us; }

 private:
  struct State {
    bool cut = false;
    bool stopped = false;
    std::int64_t every_us = 0, run_again_us = 0;  // while it is slow
    std::int64_t well_since_us = 0;
    /// Number of its sessions when the server died, as long as it has no newer one; -1: it has.
    std::int64_t lost_session = -1;
    const Client* loser = nullptr;  // the client that had it
  };
  const State& at(int client) const { return *clients_[static_cast<std::size_t>(client)]; }
  State& at(int client) { return *clients_[static_cast<std::size_t>(client)]; }
  void Begin(const Fault& fault, Cluster& cluster);
  void End(const Fault& fault, Cluster& cluster);
  void RunSlowly(Cluster& cluster);
  void KillServer(const Fault& fault, Cluster& cluster);
  void FindSessions(Cluster& cluster);

  const FaultPlan& plan_;
  std::vector<std::unique_ptr<State>> clients_;  // where CutNet finds them
  std::vector<MovableNet*> nets_;                // the newest of each client
  std::uint16_t next_port_ = 40000;
  std::size_t next_ = 0;                         // of the plan's faults
  std::vector<Fault> running_;
};

}  // namespace seam
