/// When a holder returns a mechanism to the server, every client that needs the change hears of it,
/// not only the holder.

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>

#include "client/embed/cluster.h"
#include "tests/support/soak/server_test_access.h"

namespace seam {
namespace handed_back_cluster_test {

/// If the plan's followers equalled those left by the revocation, nobody else was informed: seed
/// 400001 of the soak of narrow rooms.
TEST(HandedBackCluster, NearbyClientsHearOfItWithinTwoSeconds) {
  const Scene scene = LoadScene("scenes/swarm.toml");
  ClusterConfig config;
  config.scene = "swarm";
  config.scene_text = "follow = 0\nserver_follow = 0\n" + scene.text;
  config.players = 4;
  config.impair = "demo";
  config.drive = Drive::kScript;
  config.keep = false;
  config.duration_s = 8;
  Cluster cluster(config);
  const auto& table = cluster.server().replica().authority();
  std::map<int, std::int32_t> epochs;                      // by mechanism
  std::map<std::pair<int, int>, std::int64_t> stray_tick;  // client, mechanism: since when
  int backs = 0, stray = 0;
  for (std::int64_t tick = 1; tick <= 8 * 60; ++tick) {
    cluster.RunToTick(tick);
    for (int m = 0; m < table.count(); ++m) {
      const auto [it, fresh] = epochs.emplace(m, table.at(m).epoch);
      if (!fresh && it->second != table.at(m).epoch && table.at(m).authority == 0) ++backs;
      it->second = table.at(m).epoch;
      for (int c = 0; c < cluster.client_count(); ++c) {
        const Client& client = *cluster.client(c);
        if (!client.running()) continue;
        const bool near =
            ServerTestAccess::RelevanceOf(cluster.server(), client.peer(), m) >= Relevance::kNear;
        const bool knows = client.replica()->authority().at(m).epoch >= table.at(m).epoch;
        if (!near || knows) {
          stray_tick.erase({c, m});
          continue;
        }
        const std::int64_t since = stray_tick.emplace(std::make_pair(c, m), tick).first->second;
        if (tick - since > 2 * 60) ++stray;
      }
    }
  }
  EXPECT_GT(backs, 5) << "crates come to rest behind the sleds";
  EXPECT_EQ(stray, 0) << "client-ticks in which one near it did not know";
}

}  // namespace handed_back_cluster_test
}  // namespace seam
