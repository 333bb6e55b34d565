/// Every scene of the large world crosses a seam under the 4g profile: no body is lost, doubled or
/// torn, no mechanism has two authorities, and all peers end with the same composition.

#include <gtest/gtest.h>

#include <set>

#include "tests/support/two_sides.h"

namespace seam {
namespace world_scenes_test {

class WorldScene : public ::testing::TestWithParam<const char*> {};

TEST_P(WorldScene, CrossesTheSeamsUnder4gWholeAndWithOneAuthority) {
  ClusterConfig config;
  config.scene = GetParam();
  config.reconcile = "retrospect";
  config.impair = "4g";
  config.keep = false;
  Cluster cluster(config);
  const Replica& server = cluster.server().replica();
  std::set<std::pair<PartId, int>> holders;
  int twice = 0;
  cluster.each_instant = [&] {
    for (int m = 0; m < server.authority().count(); ++m) {
      holders.emplace(server.authority().id(m), server.authority().at(m).authority);
    }
    twice += SecondAuthorities(&cluster);
  };
  cluster.Run();
  // Edits of the last moment are still under way.
  const auto behind = [&] {
    for (int i = 0; i < cluster.client_count(); ++i) {
      if (cluster.client(i)->replica()->revision() != server.revision()) return true;
    }
    return false;
  };
  for (int n = 0; n < 20 && behind(); ++n) cluster.RunToTick(server.tick() + 6);
  EXPECT_EQ(twice, 0);
  const World& truth = server.world();
  std::set<int> peers;
  for (const auto& [mechanism, peer] : holders) peers.insert(peer);
  EXPECT_GE(peers.size(), 3u) << "the server's at first, then at least two players'";
  for (int i = 0; i < cluster.client_count(); ++i) {
    const Replica& replica = *cluster.client(i)->replica();
    EXPECT_EQ(replica.revision(), server.revision()) << "client " << i;
    ASSERT_EQ(replica.world().composition().hash, truth.composition().hash) << "client " << i;
    ASSERT_EQ(replica.world().body_count(), truth.body_count());
    for (int b = 0; b < truth.body_count(); ++b) {
      EXPECT_TRUE(replica.world().Read(b).position.allFinite());
      // A large distance means a lost body; views of one body differ by a message's age.
      EXPECT_LT((replica.world().Read(b).position - truth.Read(b).position).norm(), 15)
          << "client " << i << " body " << truth.id(b);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, WorldScene,
                         ::testing::Values("titanic", "skyline", "regatta", "harbour", "ragdolls",
                                           "obstacle", "crane", "gluehouse", "conveyor",
                                           "playground", "headon", "rally", "seesaw", "scrum",
                                           "heap", "train", "freight", "tracks", "dockside",
                                           "battlefield"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace world_scenes_test
}  // namespace seam
