/// scenes/titanic.toml and scenes/gluehouse.toml over a bad network: breaks and bonds are the same
/// on every peer.

#include <gtest/gtest.h>

#include <algorithm>

#include "common/sync/edits/edit_order.h"
#include "tests/support/soak.h"
#include "tests/support/two_sides.h"

namespace seam {
namespace assembly_cluster_test {

int Count(const Scene& scene, bool (*what)(const Joint&)) {
  return static_cast<int>(std::count_if(scene.joints.begin(), scene.joints.end(), what));
}

bool IsBroken(const Joint& joint) { return joint.kind == JointKind::kGlue && joint.gone; }
bool IsBonded(const Joint& joint) { return joint.name.rfind("bond.", 0) == 0; }

/// Runs a scene and a bit on, until nothing more is under way.
std::unique_ptr<Cluster> Played(const std::string& scene, std::int64_t seed,
                                const std::string& text = "", bool keep = false) {
  ClusterConfig config;
  config.scene = scene;
  config.scene_text = text;
  config.reconcile = "retrospect";
  config.impair = "4g";
  config.seed = seed;
  config.keep = keep;
  auto cluster = std::make_unique<Cluster>(config);
  const Server& server = cluster->server();
  auto tick = static_cast<std::int64_t>(cluster->scene().duration_s * 60);
  cluster->RunToTick(tick);
  int edits = -1;
  for (int more = 0; more < 10 && edits != server.replica().revision(); ++more) {
    edits = server.replica().revision();
    tick += 60;
    cluster->RunToTick(tick);
  }
  EXPECT_EQ(edits, server.replica().revision()) << "it goes on breaking";
  return cluster;
}

void ExpectAgreement(Cluster* cluster) {
  const Replica& truth = cluster->server().replica();
  std::vector<int> holders(static_cast<std::size_t>(truth.authority().count()), 0);
  for (int m = 0; m < truth.authority().count(); ++m) {
    holders[static_cast<std::size_t>(m)] += truth.authority().at(m).authority == 0 ? 1 : 0;
  }
  for (int i = 0; i < cluster->client_count(); ++i) {
    const Client& client = *cluster->client(i);
    const Replica& replica = *client.replica();
    ASSERT_EQ(replica.revision(), truth.revision()) << "client " << i;
    ASSERT_EQ(replica.world().composition().hash, truth.world().composition().hash);
    for (int m = 0; m < truth.authority().count(); ++m) {
      const bool has = replica.authority().at(m).authority == client.peer();
      holders[static_cast<std::size_t>(m)] += has ? 1 : 0;
      if (!has) continue;
      EXPECT_EQ(replica.authority().at(m).epoch, truth.authority().at(m).epoch);
    }
  }
  for (const int held : holders) EXPECT_EQ(held, 1) << "one authority for each";
}

class AssemblyCluster : public ::testing::TestWithParam<int> {};

TEST_P(AssemblyCluster, TheShipLosesItsBowForAllPeersAlike) {
  const auto cluster = Played("titanic", GetParam());
  ExpectAgreement(cluster.get());
  const World& world = cluster->server().replica().world();
  EXPECT_GE(Count(world.scene(), IsBroken), 10);
  const auto assembly = [&world](const std::string& name) {
    for (const Part& part : world.scene().parts) {
      if (part.name == name) {
        return world.composition().assembly_of_part[static_cast<std::size_t>(part.id)];
      }
    }
    return -1;
  };
  EXPECT_NE(assembly("bow.0.0"), assembly("fore.24.0"));
  EXPECT_EQ(assembly("aft.0.0"), assembly("fore.0.0"));
}

TEST_P(AssemblyCluster, TheHouseFallsToPiecesAndPiecesJoinForAllPeersAlike) {
  const auto cluster = Played("gluehouse", GetParam());
  ExpectAgreement(cluster.get());
  EXPECT_GE(Count(cluster->server().replica().world().scene(), IsBroken), 3);
  EXPECT_GE(Count(cluster->server().replica().world().scene(), IsBonded), 1);
}

/// Stacks on both sides; ann's ball rolls into the one on bob's side after they have been grouped.
const std::string kStacks = std::string(R"(
duration = 7
buffer = 4
[grouping]
after = 0.5
)") + kTwoSides + R"(
[[part]]
name = "ground"
chain = [[-100, 0], [100, 0]]
[[part]]
name = "box"
box = [1, 1]
position = [-12, 0.515]
repeat = {count = [2, 3], step = [24, 1.015]}
[[part]]
name = "ball"
circle = 0.5
density = 3
position = [-8, 0.5]
velocity = [5, 0]
spin = -10
)";

TEST_P(AssemblyCluster, GroupsAreMadeAndUndoneForAllPeersAlike) {
  const auto cluster = Played("stacks", GetParam(), kStacks, true);
  ExpectAgreement(cluster.get());
  const Scene& scene = cluster->server().replica().world().scene();
  EXPECT_GE(Count(scene, IsBonded), 4) << "both stacks were grouped";
  // Later bonds may have reused their slots: the recording knows the broken joints.
  const auto& edits = cluster->recording().edits;
  const auto broken = std::count_if(edits.begin(), edits.end(), [](const auto& numbered) {
    return numbered.second.kind == ToOrder(Edit(BreakEdit{})).kind;
  });
  EXPECT_GE(broken, 2) << "the one that was hit was undone";
}

INSTANTIATE_TEST_SUITE_P(Seeds, AssemblyCluster, ::testing::ValuesIn(SoakSeeds(1, 3)));

}  // namespace assembly_cluster_test
}  // namespace seam
