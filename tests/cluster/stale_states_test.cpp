/// Replayed States messages reach nobody.

#include <gtest/gtest.h>

#include <map>
#include <utility>
#include <variant>

#include "client/embed/cluster.h"
#include "tests/support/path/rewriting_net.h"
#include "tests/support/pendulums.h"

namespace seam {
namespace stale_states_test {

TEST(StaleStates, AReplayedMessageReachesNeitherOtherClientsNorTheBus) {
  ClusterConfig config;
  config.scene = "pendulums.toml";
  config.scene_text = Pendulums(4);
  config.impair = "perfect";
  config.duration_s = 4;
  Bytes first;
  int sent = 0, replayed = 0;
  config.client_net = [&](std::size_t client, std::unique_ptr<Net> net) -> std::unique_ptr<Net> {
    if (client != 0) return net;
    return std::make_unique<RewritingNet>(std::move(net), [&](std::int64_t, Bytes* message) {
      if (!std::holds_alternative<PackedStates>(Decode(*message))) return true;
      if (first.empty()) first = *message;
      if (++sent % 3 != 0) return true;
      *message = first;
      ++replayed;
      return true;
    });
  };
  Cluster cluster(config);
  cluster.Run();
  EXPECT_GT(replayed, 10);
  std::map<std::pair<int, int>, std::int64_t> newest;  // (peer, body) -> tick
  int again = 0;
  for (const States& states : cluster.recording().states) {
    for (const std::int32_t id : states.id) {
      const auto [it, fresh] = newest.emplace(std::pair(states.peer, id), states.tick);
      if (fresh) continue;
      again += states.tick <= it->second ? 1 : 0;
      it->second = states.tick;
    }
  }
  EXPECT_EQ(again, 0) << "on the bus";
  EXPECT_EQ(cluster.client(1)->stats().dropped_stale, 0) << "to bob";
  EXPECT_GE(cluster.server().stats().dropped_stale, replayed) << "dropped without being counted";
}

}  // namespace stale_states_test
}  // namespace seam
