#include "tests/support/soak/fault_runner.h"

#include <algorithm>
#include <utility>

#include "tests/support/soak/cut_net.h"

namespace seam {

FaultRunner::FaultRunner(const FaultPlan& plan) : plan_(plan) {
  const ClusterConfig& config = plan.config;
  const Scene scene = config.scene_text.empty() ? LoadScene("scenes/" + config.scene + ".toml")
                                                : ParseScene(config.scene_text, config.scene);
  std::size_t count = scene.players.size();
  if (config.players > 0) count = std::min(count, static_cast<std::size_t>(config.players));
  count += static_cast<std::size_t>(config.spectators);
  for (std::size_t i = 0; i < count; ++i) clients_.push_back(std::make_unique<State>());
}

ClusterConfig FaultRunner::Config() {
  ClusterConfig config = plan_.config;
  config.client_net = [this](std::size_t client, std::unique_ptr<Net> net) {
    return std::make_unique<CutNet>(std::move(net), &clients_[client]->cut);
  };
  return config;
}

void FaultRunner::Act(Cluster& cluster) {
  const double now_s = static_cast<double>(cluster.server().tick()) /
                       static_cast<double>(cluster.scene().solver.tick_hz);
  for (std::size_t i = 0; i < running_.size();) {
    if (running_[i].to_s > now_s) {
      ++i;
      continue;
    }
    End(running_[i], cluster);
    running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  for (; next_ < plan_.faults.size() && plan_.faults[next_].from_s <= now_s; ++next_) {
    Begin(plan_.faults[next_], cluster);
    running_.push_back(plan_.faults[next_]);
  }
  RunSlowly(cluster);
}

void FaultRunner::Begin(const Fault& fault, Cluster& cluster) {
  State& state = at(fault.client);
  state.well_since_us = -1;
  switch (fault.kind) {
    case FaultKind::kCut: state.cut = true; break;
    case FaultKind::kPause:
      state.stopped = true;
      cluster.Pause(fault.client, true);
      break;
    case FaultKind::kSlowed: state.every_us = fault.every_us; break;
    case FaultKind::kKill:
      state.stopped = true;
      cluster.Kill(fault.client);
      break;
    case FaultKind::kLeave:
      state.stopped = true;
      cluster.Leave(fault.client);
      break;
  }
}

void FaultRunner::End(const Fault& fault, Cluster& cluster) {
  State& state = at(fault.client);
  state = State();
  state.well_since_us = cluster.now_us();
  const bool gone = fault.kind == FaultKind::kKill || fault.kind == FaultKind::kLeave;
  if (gone) cluster.Revive(fault.client);
  cluster.Pause(fault.client, false);
}

void FaultRunner::RunSlowly(Cluster& cluster) {
  for (int client = 0; client < static_cast<int>(clients_.size()); ++client) {
    State& state = at(client);
    if (state.every_us == 0) continue;
    // It has just run, if it was not paused: it is paused until it is to run again.
    const bool runs = cluster.now_us() >= state.run_again_us;
    if (runs) state.run_again_us = cluster.now_us() + state.every_us;
    cluster.Pause(client, !runs);
  }
}

}  // namespace seam
