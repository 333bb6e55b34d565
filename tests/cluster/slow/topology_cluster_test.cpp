/// Splitting and merging across peers, under loss and reorder: the real server and clients in
/// virtual time. All peers have the same order, the same roots and one authority, and a diverged
/// peer is repaired.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "common/physics/part_places.h"
#include "common/sync/edits/edit_order.h"
#include "server/edits/proposal.h"
#include "tests/support/soak.h"
#include "tests/support/two_sides.h"

namespace seam {
namespace topology_cluster_test {

/// A bar of four glued boxes slides from ann's side to bob's; a crate lies where it passes.
const std::string kBar = std::string("duration = 6\nbuffer = 8\n") + kTwoSides + R"(
[[part]]
name = "floor"
box = [80, 1]
position = [0, -0.5]
anchored = true
friction = 0.1
[[part]]
name = "bar"
box = [1, 0.5]
position = [-8, 0.265]
velocity = [4, 0]
friction = 0.1
repeat = {count = 4, step = [1, 0]}
[[joint]]
name = "glue"
kind = "glue"
a = "bar.0"
b = "bar.1"
strength = 1000
repeat = {count = 3, step = [1, 0]}
[[part]]
name = "crate"
box = [0.8, 0.8]
position = [3, 0.42]
friction = 0.3
)";

Edit Break(int joint) { return Edit(BreakEdit{joint}, EditCause::kOutside); }

PartId PartNamed(const Scene& scene, const std::string& name) {
  for (const Part& part : scene.parts) {
    if (part.name == name) return part.id;
  }
  return -1;
}

Edit BondNow(const World& world, PartId a, PartId b) {
  return Edit(BondAsTheyAre(world, a, b, 0), EditCause::kOutside);
}

/// At every instant: a peer that believes it has a mechanism in the server's epoch is the server's
/// holder.
void ExpectOneAuthority(Cluster* cluster) {
  ASSERT_EQ(SecondAuthorities(cluster), 0) << "two authorities";
  const Replica& server = cluster->server().replica();
  for (int i = 0; i < cluster->client_count(); ++i) {
    const Client* client = cluster->client(i);
    if (client == nullptr || !client->running()) continue;
    const Replica& replica = *client->replica();
    if (replica.revision() != server.revision()) continue;
    ASSERT_EQ(replica.world().composition().hash, server.world().composition().hash);
    for (int m = 0; m < server.authority().count(); ++m) {
      const AuthorityRecord& ours = server.authority().at(m);
      const AuthorityRecord& theirs = replica.authority().at(m);
      ASSERT_LE(theirs.epoch, ours.epoch + 1) << "ahead only by what is being revoked";
    }
  }
}

class TopologyUnder : public ::testing::TestWithParam<const char*> {};

TEST_P(TopologyUnder, EditsKeepTheirOrderAndEndTheSameEverywhere) {
  for (const int seed : SoakSeeds(1, 3)) {
    ClusterConfig config;
    config.scene_text = kBar;
    config.reconcile = "retrospect";
    config.impair = GetParam();
    config.seed = seed;
    Cluster cluster(config);
    cluster.each_instant = [&] { ExpectOneAuthority(&cluster); };
    cluster.RunToTick(70);  // about at the seam
    Server& server = cluster.server();
    server.Order(Break(1));
    cluster.RunToTick(130);
    const PartId crate = PartNamed(server.replica().world().scene(), "crate");
    const InsertEdit late{"[[part]]\nname = \"late\"\nbox = [0.5, 0.5]\nposition = [-2, 4]\n"};
    server.Order(Edit(late, EditCause::kOutside));
    server.Order(Edit(PushEdit{crate, {0, 1}}, EditCause::kOutside));
    cluster.RunToTick(160);
    // The crate and the front half, under any holders: one holder gets both first.
    server.Order(BondNow(server.replica().world(), 4, crate));
    cluster.RunToTick(260);
    server.Order(Edit(RemoveEdit{1}));
    cluster.Run();
    const Replica& truth = server.replica();
    EXPECT_EQ(truth.revision(), 5) << "seed " << seed;
    const std::uint64_t hash = truth.world().composition().hash;
    std::set<PartId> roots;
    for (int b = 0; b < truth.world().body_count(); ++b) roots.insert(truth.world().id(b));
    EXPECT_EQ(roots.size(), 3u) << "rear, front with crate, late";
    for (int i = 0; i < cluster.client_count(); ++i) {
      const Replica& replica = *cluster.client(i)->replica();
      EXPECT_EQ(replica.revision(), 5) << "seed " << seed << " client " << i;
      EXPECT_EQ(replica.world().composition().hash, hash) << "seed " << seed << " client " << i;
      for (int b = 0; b < replica.world().body_count(); ++b) {
        const float apart =
            (replica.world().Read(b).position - truth.world().Read(b).position).norm();
        EXPECT_LT(apart, 0.1f) << "seed " << seed << " client " << i << " body "
                               << replica.world().id(b);
      }
    }
    // The recording has every edit once, in order.
    const auto& edits = cluster.recording().edits;
    ASSERT_EQ(edits.size(), 5u);
    EXPECT_EQ(edits.begin()->first, 0);
    EXPECT_EQ(edits.rbegin()->first, 4);
  }
}

INSTANTIATE_TEST_SUITE_P(Networks, TopologyUnder, ::testing::Values("perfect", "4g", "terrible"));

TEST(TopologyCluster, ADivergedPeerIsFoundAndRepaired) {
  ClusterConfig config;
  config.scene_text = kBar;
  config.reconcile = "retrospect";
  config.impair = "4g";
  Cluster cluster(config);
  cluster.RunToTick(60);
  // Behind everybody's back: bob's copy breaks where nobody ordered it to.
  EditOrder wrong = ToOrder(Break(2));
  wrong.number = 0;
  auto* bob = const_cast<Replica*>(cluster.client(1)->replica());
  ASSERT_TRUE(bob->Queue(wrong));
  cluster.RunToTick(63);
  ASSERT_NE(cluster.client(1)->replica()->world().composition().hash,
            cluster.server().replica().world().composition().hash);
  cluster.server().Order(Break(0));
  cluster.Run();
  EXPECT_EQ(cluster.client(1)->replica()->revision(), 1);
  EXPECT_EQ(cluster.client(1)->replica()->world().composition().hash,
            cluster.server().replica().world().composition().hash);
  bool said = false;
  for (const Event& event : cluster.recording().events) {
    said = said || event.text.find("another composition") != std::string::npos;
  }
  EXPECT_TRUE(said);
  const World& truth = cluster.server().replica().world();
  for (int b = 0; b < truth.body_count(); ++b) {
    EXPECT_LT(
        (cluster.client(1)->replica()->world().Read(b).position - truth.Read(b).position).norm(),
        0.1f);
  }
}

TEST(TopologyCluster, ARepairedClientNeverShowsTheInitialPoses) {
  // So much that its world does not come in one datagram.
  const std::string many = kBar + R"(
[[part]]
name = "pebble"
circle = 0.1
position = [-39, 0.1]
repeat = {count = 120, step = [0.22, 0]}
[[part]]
name = "ball"  # the last to be told of
circle = 0.3
position = [12, 0.3]
velocity = [4, 0]
)";
  for (std::int64_t seed = 1; seed <= 4; ++seed) {
    ClusterConfig config;
    config.seed = seed;
    config.scene_text = many;
    config.reconcile = "rollback";
    config.impair = "delay=50ms,loss=50%";
    config.show_age_ticks = 0;  // a view of the past goes back where it begins anew
    Cluster cluster(config);
    cluster.RunToTick(100);
    EditOrder wrong = ToOrder(Break(2));
    wrong.number = 0;
    auto* bob = const_cast<Replica*>(cluster.client(1)->replica());
    ASSERT_TRUE(bob->Queue(wrong));
    int highest = 0;
    cluster.each_instant = [&] {
      const Replica* his = cluster.client(1)->replica();
      if (his != nullptr) highest = std::max(highest, his->revision());
    };
    cluster.Run();
    EXPECT_EQ(highest, 1) << "seed " << seed << ": he had it, and began anew";
    EXPECT_EQ(cluster.client(1)->replica()->revision(), 0) << "seed " << seed;
    double farthest = -100;
    for (const auto& [tick, view] : cluster.recording().views.at(2)) {
      const double x = view.x.back();
      EXPECT_GT(x, farthest - 1.5) << "it began at 12: seed " << seed << ", tick " << tick;
      farthest = std::max(farthest, x);
    }
    EXPECT_GT(farthest, 25) << "seed " << seed << ": the ball rolls to the right";
  }
}

TEST(TopologyCluster, ALatecomerGetsAllEdits) {
  ClusterConfig config;
  config.scene_text = kBar;
  config.reconcile = "retrospect";
  config.impair = "4g";
  Cluster cluster(config);
  cluster.RunToTick(60);
  cluster.Kill(1);
  cluster.server().Order(Break(1));
  cluster.RunToTick(120);
  cluster.server().Order(Break(0));
  cluster.Revive(1);
  cluster.Run();
  const Client* bob = cluster.client(1);
  ASSERT_TRUE(bob->running());
  EXPECT_EQ(bob->replica()->revision(), 2);
  EXPECT_EQ(bob->replica()->world().composition().hash,
            cluster.server().replica().world().composition().hash);
}

TEST(TopologyCluster, AClientMayOnlyProposeEditsThatPhysicsFindsOnItsOwnBodies) {
  ClusterConfig config;
  config.scene_text = kBar;
  config.reconcile = "retrospect";
  config.impair = "perfect";
  Cluster cluster(config);
  cluster.RunToTick(30);  // the bar is ann's
  const Topology& topology = cluster.server().replica().world().topology();
  EXPECT_FALSE(MayPropose(topology, Edit(FreeEdit{0})));
  EXPECT_FALSE(MayPropose(topology, Edit(RemoveEdit{0})));
  EXPECT_FALSE(MayPropose(topology, Break(0))) << "not said to be physics";
  Edit physics = Break(0);
  physics.cause = EditCause::kPhysics;
  EXPECT_TRUE(MayPropose(topology, physics));
}

TEST(TopologyCluster, ADriverGetsInDrivesAndGetsOut) {
  ClusterConfig config;
  config.scene_text = R"(
duration = 8
buffer = 10
[[player]]
name = "ann"
vehicle = "ann-body"
region = [[-1000, -1000], [-0.001, 1000]]
script = [[0.0, {}], [1.0, {buttons = [3]}], [1.1, {}], [2.0, {drive = 1}], [4.0, {}],
          [5.0, {buttons = [3]}], [5.1, {}], [5.5, {drive = 1}]]
[[player]]
name = "bob"
region = [[0, -1000], [1000, 1000]]
[[part]]
name = "floor"
box = [200, 1]
position = [0, -0.5]
anchored = true
friction = 0.9
[[part]]
name = "cart"
box = [2, 0.4]
position = [-3, 0.8]
[[part]]
name = "wheel"
circle = 0.4
position = [-3.7, 0.41]
friction = 0.9
repeat = {count = 2, step = [1.4, 0]}
[[joint]]
name = "axle"
kind = "revolute"
a = "cart"
b = "wheel.0"
motor = {player = "driver", speed = -8, torque = 20}
[[joint]]
name = "axle2"
kind = "revolute"
a = "cart"
b = "wheel.1"
motor = {player = "driver", speed = -8, torque = 20}
[[part]]
name = "ann-body"
box = [0.4, 0.8]
position = [-5, 0.41]
owner = "ann"
friction = 0.9
[[seat]]
name = "driver"
part = "cart"
at = [0, 0.7]
reach = 3
button = 3
)";
  config.reconcile = "retrospect";
  config.impair = "4g";
  Cluster cluster(config);
  cluster.each_instant = [&] { ExpectOneAuthority(&cluster); };
  const World& world = cluster.server().replica().world();
  const auto mechanism_of = [&](const std::string& name) {
    const Composition& c = world.composition();
    const auto part = static_cast<std::size_t>(PartNamed(world.scene(), name));
    return c.assemblies[static_cast<std::size_t>(c.assembly_of_part[part])].mechanism;
  };
  cluster.RunToTick(50);
  EXPECT_NE(mechanism_of("cart"), mechanism_of("ann-body"));
  cluster.RunToTick(240);
  EXPECT_EQ(world.scene().seats[0].player, 0);
  EXPECT_EQ(mechanism_of("cart"), mechanism_of("ann-body"));
  EXPECT_EQ(cluster.server().replica().authority().at(mechanism_of("cart")).authority, 1)
      << "ann's, also beyond the seam";
  EXPECT_GT(PartPose(world, PartNamed(world.scene(), "cart")).position.x(), 0);
  cluster.Run();
  EXPECT_EQ(world.scene().seats[0].player, -1);
  EXPECT_NE(mechanism_of("cart"), mechanism_of("ann-body"));
  const float end = PartPose(world, PartNamed(world.scene(), "cart")).velocity.norm();
  EXPECT_LT(end, 0.5f) << "nobody drives";
}

}  // namespace topology_cluster_test
}  // namespace seam
