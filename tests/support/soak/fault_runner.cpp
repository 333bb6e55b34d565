#include "tests/support/soak/fault_runner.h"

#include <algorithm>
#include <utility>

#include "tests/support/soak/cut_net.h"
#include "tests/support/soak/movable_net.h"

namespace seam {

FaultRunner::FaultRunner(const FaultPlan& plan) : plan_(plan) {
  const ClusterConfig& config = plan.config;
  const Scene scene = config.scene_text.empty() ? LoadScene("scenes/" + config.scene + ".toml")
                                                : ParseScene(config.scene_text, config.scene);
  std::size_t count = scene.players.size();
  if (config.players > 0) count = std::min(count, static_cast<std::size_t>(config.players));
  count += static_cast<std::size_t>(config.spectators);
  for (std::size_t i = 0; i < count; ++i) clients_.push_back(std::make_unique<State>());
  nets_.resize(count);
}

ClusterConfig FaultRunner::Config() {
  ClusterConfig config = plan_.config;
  config.client_net = [this](std::size_t client, std::unique_ptr<Net> net) {
    auto movable = std::make_unique<MovableNet>(std::move(net));
    nets_[client] = movable.get();
    return std::make_unique<CutNet>(std::move(movable), &clients_[client]->cut);
  };
  return config;
}

void FaultRunner::Act(Cluster& cluster) {
  FindSessions(cluster);
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

void FaultRunner::KillServer(const Fault& fault, Cluster& cluster) {
  if (!restart_server || !restart_server(cluster, fault.every_us)) return;
  for (std::size_t c = 0; c < clients_.size(); ++c) {
    State& state = *clients_[c];
    const Client* const client = cluster.client(static_cast<int>(c));
    if (client == nullptr) continue;
    state.lost_session = client->sessions();
    state.loser = client;
    if (state.well_since_us >= 0) state.well_since_us = cluster.now_us() + fault.every_us;
  }
}

void FaultRunner::FindSessions(Cluster& cluster) {
  for (std::size_t c = 0; c < clients_.size(); ++c) {
    State& state = *clients_[c];
    if (state.lost_session < 0) continue;
    const Client* const client = cluster.client(static_cast<int>(c));
    const bool same = client == state.loser && client->sessions() == state.lost_session;
    if (!same) state.lost_session = -1;
  }
}

void FaultRunner::Begin(const Fault& fault, Cluster& cluster) {
  if (fault.kind == FaultKind::kServer) return KillServer(fault, cluster);
  if (fault.kind == FaultKind::kMove) {
    const Address address{0x7f000001, next_port_++};
    const bool there = cluster.client(fault.client) != nullptr;
    if (there) nets_[static_cast<std::size_t>(fault.client)]->Move(cluster.Attach(address));
    return;
  }
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
    case FaultKind::kMove:
    case FaultKind::kServer: break;
  }
}

void FaultRunner::End(const Fault& fault, Cluster& cluster) {
  if (fault.kind == FaultKind::kServer || fault.kind == FaultKind::kMove) return;
  State& state = at(fault.client);
  const State was = std::exchange(state, State());
  state.lost_session = was.lost_session;
  state.loser = was.loser;
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
