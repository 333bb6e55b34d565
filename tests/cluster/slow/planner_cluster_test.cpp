/// Authority by contact islands in whole sessions: a player that touches a body gets it, clients do
/// the work, and there is never a second authority.

#include <gtest/gtest.h>

#include <cstdio>

#include "client/embed/cluster.h"
#include "tests/lab/load/load.h"
#include "tests/support/plan/plain_scene.h"
#include "tests/support/two_sides.h"

namespace seam {
namespace planner_cluster_test {

ClusterConfig Plain(const PlainScene& plain) {
  ClusterConfig config;
  config.scene = "plain";
  config.scene_text = PlainText(plain);
  config.drive = Drive::kBot;
  config.keep = false;
  return config;
}

TEST(PlannerCluster, SeparatedClientsHoldMovingBodiesAndPairsHaveOneOwner) {
  PlainScene plain;
  plain.players = 16;
  const SessionLoad load = MeasureLoad(Plain(plain));
  std::printf("apart: %.1f %% held by clients, %.1f %% of touching pairs with two owners\n",
              100 * load.held_share, 100 * load.split_share);
  EXPECT_GE(load.held_share, 0.8);
  EXPECT_LE(load.split_share, 0.08);
  EXPECT_GT(load.awake, 5);
}

TEST(PlannerCluster, IslandsThatMeetAndPartNeverHaveASecondAuthority) {
  PlainScene plain;
  plain.players = 6;
  plain.spacing = 7;
  plain.duration = 6;
  ClusterConfig config = Plain(plain);
  config.impair = "wifi_busy";
  Cluster cluster(config);
  int twice = 0;
  cluster.each_instant = [&] { twice += SecondAuthorities(&cluster); };
  cluster.Run();
  EXPECT_EQ(twice, 0);
  std::int64_t epochs = 0;
  const AuthorityTable& table = cluster.server().replica().authority();
  for (int m = 0; m < table.count(); ++m) epochs += table.at(m).epoch;
  EXPECT_GT(epochs, 2 * table.count()) << "nothing changed hands: the test sees nothing";
}

TEST(PlannerCluster, SleepingBodiesReturnToTheServer) {
  PlainScene plain;
  plain.duration = 6;
  ClusterConfig config = Plain(plain);
  config.drive = Drive::kNone;
  Cluster cluster(config);
  cluster.Run();
  const Replica& server = cluster.server().replica();
  for (int m = 0; m < server.authority().count(); ++m) {
    const Mechanism& mechanism =
        server.world().composition().mechanisms[static_cast<std::size_t>(m)];
    if (mechanism.owner >= 0) {
      EXPECT_GT(server.authority().at(m).authority, 0) << "a cart";
    } else {
      EXPECT_EQ(server.authority().at(m).authority, 0) << "a crate";
    }
  }
}

}  // namespace planner_cluster_test
}  // namespace seam
