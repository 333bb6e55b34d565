#pragma once
/// Records the joint error that the engine itself leaves in each peer's world, tick by tick: the
/// joint error of views must not exceed it.

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "client/embed/cluster.h"
#include "common/measure/joint_drift.h"

namespace seam {

class PhysicsDrift {
 public:
  /// To be called at every instant of the cluster.
  void Look(Cluster& cluster) {
    if (!cluster.server().started()) return;
    Look(0, cluster.server().replica().world());
    for (int c = 0; c < cluster.client_count(); ++c) {
      const Client* client = cluster.client(c);
      if (client == nullptr || !client->running()) continue;
      Look(client->peer(), client->replica()->world());
    }
  }
  /// Returns the largest joint error of a peer's world after that tick, m; 0: not recorded.
  double At(int peer, std::int64_t tick) const {
    const auto found = peers_.find(peer);
    if (found == peers_.end()) return 0;
    const auto drift = found->second.drifts.find(tick);
    return drift == found->second.drifts.end() ? 0 : drift->second;
  }

 private:
  struct Peer {
    int revision = -1;
    std::unique_ptr<JointMeter> meter;
    std::map<std::int64_t, double> drifts;
  };

  void Look(int peer, const World& world) {
    Peer& of = peers_[peer];
    if (!of.drifts.empty() && of.drifts.rbegin()->first >= world.tick()) return;
    const int revision = world.topology().revision();
    if (of.meter == nullptr || of.revision != revision) {
      of.meter = std::make_unique<JointMeter>(world.scene(), world.composition());
      of.revision = revision;
    }
    std::vector<BodyState> bodies;
    for (int body = 0; body < world.body_count(); ++body) bodies.push_back(world.Read(body));
    of.drifts[world.tick()] = of.meter->Worst(bodies, world.tick());
  }

  std::map<int, Peer> peers_;
};

}  // namespace seam
