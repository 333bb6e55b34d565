/// A long-running room: old edits cost nothing, and a latecomer has the same world as the others.

#include <gtest/gtest.h>

#include "common/codec/codec.h"
#include "common/sync/edits/edit_order.h"
#include "common/sync/edits/topology_snapshot.h"
#include "common/topology/topology_fold.h"
#include "tests/support/soak/paired_boxes.h"
#include "tests/support/two_sides.h"

namespace seam {
namespace long_room_test {

/// Two players, and boxes in pairs that nobody is near to.
const std::string kPairs =
    std::string("duration = 60\nbuffer = 8\ngravity = [0, 0]\n") + kTwoSides + R"(
[[part]]
name = "floor"
box = [80, 1]
position = [0, -0.5]
anchored = true
)" + kPairedBoxes;
constexpr PartId kFirst = 1;

/// Bytes of history sent to a client that joins now: as all edits, and compacted.
struct JoinBytes {
  std::size_t edits = 0, snapshot = 0;
};

JoinBytes BytesToJoin(Cluster* cluster) {
  const World& world = cluster->server().replica().world();
  Topology topology(cluster->scene());
  TopologyFold fold(topology);
  JoinBytes bytes;
  for (const auto& [number, order] : cluster->recording().edits) {
    topology.Apply({ToEdit(order)});
    fold.Note(ToEdit(order), topology);
    bytes.edits += Encode(order).size();
  }
  EXPECT_EQ(topology.composition().hash, world.composition().hash) << "the log has it all";
  const std::vector<Snapshot> parts = ToSnapshots(topology.revision(), fold.Entries(topology));
  SnapshotReader reader(cluster->scene());
  for (const Snapshot& part : parts) {
    bytes.snapshot += Encode(part).size();
    const Status status = reader.Take(part);
    EXPECT_TRUE(status.ok()) << status.why();
  }
  EXPECT_TRUE(reader.complete());
  EXPECT_EQ(reader.topology().composition().hash, world.composition().hash);
  return bytes;
}

void ExpectLateJoinerIsTheSame(Cluster* cluster) {
  cluster->Kill(1);
  cluster->RunToTick(cluster->server().tick() + 240);
  cluster->Revive(1);
  cluster->RunToTick(cluster->server().tick() + 240);
  ASSERT_TRUE(cluster->client(1)->running()) << cluster->client(1)->fatal();
  const Replica& truth = cluster->server().replica();
  for (int i = 0; i < 2; ++i) {
    const Replica& replica = *cluster->client(i)->replica();
    EXPECT_EQ(replica.revision(), truth.revision()) << i;
    EXPECT_EQ(replica.world().composition().hash, truth.world().composition().hash) << i;
    EXPECT_EQ(replica.world().scene().joints.size(), truth.world().scene().joints.size()) << i;
  }
}

ClusterConfig Pairs() {
  ClusterConfig config;
  config.scene_text = kPairs;
  config.reconcile = "retrospect";
  config.impair = "perfect";
  config.drive = Drive::kNone;
  return config;
}

TEST(LongRoom, TwentyThousandPushesDoNotEndIt) {
  Cluster cluster(Pairs());
  cluster.RunToTick(60);
  Server& server = cluster.server();
  for (int tick = 0; tick < 200; ++tick) {
    for (int push = 0; push < 100; ++push) {
      const float way = push % 2 == 0 ? 0.001f : -0.001f;
      server.Order(Edit(PushEdit{kFirst, {way, 0}}, EditCause::kOutside));
    }
    cluster.RunToTick(server.tick() + 1);
  }
  cluster.RunToTick(server.tick() + 5);
  EXPECT_EQ(server.replica().revision(), 20000);
  server.Order(Edit(RemoveEdit{kFirst}, EditCause::kOutside));
  cluster.RunToTick(server.tick() + 2);
  EXPECT_EQ(server.replica().revision(), 20001);
  EXPECT_TRUE(server.replica().world().scene().parts[kFirst].gone);
  ExpectLateJoinerIsTheSame(&cluster);
}

TEST(LongRoom, GlueThatFormsAndBreaksForEverDoesNotGrowIt) {
  Cluster cluster(Pairs());
  cluster.RunToTick(60);
  BondAndBreak(&cluster, kFirst, 1250);
  const Replica& truth = cluster.server().replica();
  EXPECT_EQ(truth.revision(), 20000) << "ten thousand of each";
  EXPECT_LE(truth.world().scene().joints.size(), static_cast<std::size_t>(kPairCount));
  ExpectLateJoinerIsTheSame(&cluster);
  const JoinBytes bytes = BytesToJoin(&cluster);
  EXPECT_LT(bytes.snapshot, 2000u);
  EXPECT_GT(bytes.edits, 1000000u);
  RecordProperty("edits_bytes", static_cast<int>(bytes.edits));
  RecordProperty("snapshot_bytes", static_cast<int>(bytes.snapshot));
}

/// The history of any played world compacts well.
TEST(LongRoom, ASnapshotEqualsThePlayedWorldAndIsShorterThanItsEdits) {
  for (const char* scene : {"gluehouse", "playground", "conveyor", "harbour", "obstacle"}) {
    SCOPED_TRACE(scene);
    ClusterConfig config;
    config.scene = scene;
    config.duration_s = 6;
    config.impair = "4g";
    config.seed = 3;
    Cluster cluster(config);
    cluster.Run();
    const JoinBytes bytes = BytesToJoin(&cluster);
    EXPECT_LE(bytes.snapshot, bytes.edits + 100);
    RecordProperty(std::string(scene) + "_edits_bytes", static_cast<int>(bytes.edits));
    RecordProperty(std::string(scene) + "_snapshot_bytes", static_cast<int>(bytes.snapshot));
  }
}

TEST(LongRoom, AClientThatJoinsDuringManyEditsUnderLossEndsTheSame) {
  ClusterConfig config = Pairs();
  config.impair = "loss=20%,delay=40ms";
  Cluster cluster(config);
  cluster.RunToTick(60);
  Server& server = cluster.server();
  const auto edits = [&](int ticks) {  // 120 a second
    for (int tick = 0; tick < ticks; ++tick) {
      server.Order(Edit(PushEdit{kFirst, {0.001f, 0}}, EditCause::kOutside));
      server.Order(Edit(PushEdit{kFirst, {-0.001f, 0}}, EditCause::kOutside));
      cluster.RunToTick(server.tick() + 1);
    }
  };
  cluster.Kill(1);
  edits(2400);
  BondAndBreak(&cluster, kFirst, 2);
  cluster.Revive(1);
  edits(900);
  cluster.RunToTick(server.tick() + 180);
  ASSERT_TRUE(cluster.client(1)->running()) << cluster.client(1)->fatal();
  EXPECT_EQ(cluster.client(1)->replica()->revision(), server.replica().revision());
  EXPECT_EQ(cluster.client(1)->replica()->world().composition().hash,
            server.replica().world().composition().hash);
}

}  // namespace long_room_test
}  // namespace seam
