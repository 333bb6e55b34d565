#pragma once
/// Applies a plan's faults to a cluster's clients, at the room's time.

#include <memory>
#include <vector>

#include "tests/support/soak/fault_plan.h"

namespace seam {

class FaultRunner {
 public:
  /// `plan` must outlive this, and this the cluster made of `Config()`.
  explicit FaultRunner(const FaultPlan& plan);

  /// Returns the plan's configuration, with networks that can be cut.
  ClusterConfig Config();
  /// Begins and ends faults that are due. To be called after every virtual instant.
  void Act(Cluster& cluster);

  /// True if the client's process does not run, or there is none.
  bool Stopped(int client) const { return at(client).stopped; }
  /// Time since which the client has no fault, us of virtual time; -1: it has one.
  std::int64_t WellSince(int client) const { return at(client).well_since_us; }

 private:
  struct State {
    bool cut = false;
    bool stopped = false;
    std::int64_t every_us = 0, run_again_us = 0;  // while it is slow
    std::int64_t well_since_us = 0;
  };
  const State& at(int client) const { return *clients_[static_cast<std::size_t>(client)]; }
  State& at(int client) { return *clients_[static_cast<std::size_t>(client)]; }
  void Begin(const Fault& fault, Cluster& cluster);
  void End(const Fault& fault, Cluster& cluster);
  void RunSlowly(Cluster& cluster);

  const FaultPlan& plan_;
  std::vector<std::unique_ptr<State>> clients_;  // where CutNet finds them
  std::size_t next_ = 0;                         // of the plan's faults
  std::vector<Fault> running_;
};

}  // namespace seam
