/// The server removes mechanisms that leave the scene's bounds, for all peers, and counts them.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "client/embed/cluster.h"
#include "common/measure/measure.h"
#include "common/physics/part_places.h"
#include "common/sync/edits/edit_order.h"
#include "tests/support/two_sides.h"

namespace seam {
namespace bounds_test {

/// A stone of ann's is thrown out to the right, a barrow of nobody's with two parts rolls off to
/// the left and falls, and a crate stays.
const std::string kThrown =
    std::string("duration = 8\nbounds = [[-30, -40], [30, 60]]\n") + kTwoSides + R"(
[[part]]
name = "ground"
chain = [[-12, 0], [40, 0]]
[[part]]
name = "stone"
box = [0.4, 0.4]
position = [-4, 3]
velocity = [25, 9]
owner = "ann"
[[part]]
name = "barrow"
box = [1, 0.4]
position = [-10, 0.7]
velocity = [-4, 0]
[[part]]
name = "wheel"
circle = 0.3
position = [-10.3, 0.32]
[[joint]]
name = "axle"
kind = "hinge"
a = "barrow"
b = "wheel"
[[part]]
name = "crate"
box = [1, 1]
position = [5, 0.52]
)";

ClusterConfig Thrown(const std::string& mode) {
  ClusterConfig config;
  config.scene_text = kThrown;
  config.mode = mode;
  config.impair = "4g";
  return config;
}

/// Removals by the bounds: part and tick.
std::map<PartId, std::int64_t> Removals(const Recording& recording) {
  std::map<PartId, std::int64_t> removals;
  for (const auto& [number, order] : recording.edits) {
    const Edit edit = ToEdit(order);
    const RemoveEdit* removed = edit.As<RemoveEdit>();
    if (removed != nullptr && removed->left_bounds) removals[removed->part] = order.tick;
  }
  return removals;
}

TEST(Bounds, MechanismsThatLeaveAreCountedAndRemovedForAllPeersAtOneTick) {
  for (const std::string mode : {"buffer", "central", "strict", "oracle"}) {
    SCOPED_TRACE(mode);
    Cluster cluster(Thrown(mode));
    cluster.Run();
    const World& truth = cluster.server().replica().world();
    const std::map<PartId, std::int64_t> removals = Removals(cluster.recording());
    ASSERT_EQ(removals.size(), 3u) << "stone, barrow and wheel";
    EXPECT_EQ(removals.count(1) + removals.count(2) + removals.count(3), 3u);
    EXPECT_EQ(removals.at(2), removals.at(3)) << "a mechanism goes at once";
    EXPECT_EQ(cluster.server().left_bounds(), 3);
    EXPECT_EQ(truth.body_count(), 1) << "the crate stays";
    EXPECT_EQ(MechanismOf(truth, 1), -1);
    // 34 m at 25 m/s, then at most a round trip of the network and two messages.
    EXPECT_GE(removals.at(1), 80);
    EXPECT_LE(removals.at(1), 80 + 30);
    for (int i = 0; i < cluster.client_count(); ++i) {
      const Replica& replica = *cluster.client(i)->replica();
      EXPECT_EQ(replica.revision(), 3) << "client " << i;
      EXPECT_EQ(replica.world().composition().hash, truth.composition().hash) << "client " << i;
    }
    // Nobody has it away before that tick, and everybody within the time of an order, repeated.
    const std::int64_t tick = removals.at(1);
    for (const auto& [peer, views] : cluster.recording().views) {
      for (const auto& [at, view] : views) {
        const bool there = std::count(view.id.begin(), view.id.end(), 1) > 0;
        if (at < tick) {
          EXPECT_TRUE(there) << "peer " << peer << " tick " << at;
        }
        const std::int64_t late = mode == "oracle" ? 1 : 36;
        if (at > tick + late) {
          EXPECT_FALSE(there) << "peer " << peer << " tick " << at;
        }
      }
    }
  }
}

TEST(Bounds, TheMeasureCountsRemovedBodiesAndTheOracleRemovesThemToo) {
  Cluster cluster(Thrown("buffer"));
  cluster.Run();
  const Oracle oracle = ComputeOracle(cluster.recording(), WithBarriers(cluster.recording().room));
  const Measures measures = Measure(cluster.recording(), oracle);
  EXPECT_EQ(measures.left_bounds, 3);
  EXPECT_EQ(measures.lost.value_or(-1), 0);
  EXPECT_FALSE(oracle.At(470, 1).has_value());
  EXPECT_TRUE(oracle.At(470, 4).has_value());
}

TEST(Bounds, ALatecomerDoesNotReceiveRemovedBodies) {
  Cluster cluster(Thrown("buffer"));
  cluster.RunToTick(200);
  cluster.Kill(1);
  cluster.RunToTick(400);
  cluster.Revive(1);
  cluster.RunToTick(470);
  ASSERT_NE(cluster.client(1)->replica(), nullptr);
  EXPECT_EQ(cluster.client(1)->replica()->world().body_count(), 1);
}

}  // namespace bounds_test
}  // namespace seam
