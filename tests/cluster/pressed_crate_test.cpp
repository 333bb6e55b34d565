/// Damage follows the impacts found by the authorities: a crate between two of them, and impacts
/// between two.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <variant>

#include "client/embed/cluster.h"
#include "server/rules/rules.h"
#include "tests/cluster/rewritten_states.h"
#include "tests/support/path/rewriting_net.h"
#include "tests/support/soak.h"

namespace seam {
namespace pressed_crate_test {

/// ann's box comes from the left and bob's from the right, both push a crate between them for
/// seconds, one now and then a little less.
const char* const kPress = R"(
title = "Press"
duration = 8
buffer = 12
[[player]]
name = "ann"
vehicle = "left"
region = [[-1000, -1000], [-0.001, 1000]]
script = [[0.0, {drive = 1.0}], [3.0, {drive = 0.9}], [4.0, {drive = 1.0}]]
[[player]]
name = "bob"
vehicle = "right"
region = [[0, -1000], [1000, 1000]]
script = [[0.0, {drive = 1.0}], [2.0, {drive = 0.9}], [5.0, {drive = 1.0}]]
[[part]]
name = "ground"
chain = [[-100, 0], [100, 0]]
friction = 0.3
[[part]]
name = "left"
box = [1.6, 1]
position = [-1.31, 0.5]
friction = 0.3
owner = "ann"
[[part]]
name = "right"
box = [1.6, 1]
position = [1.11, 0.5]
friction = 0.3
owner = "bob"
[[part]]
name = "crate"
box = [0.8, 0.8]
position = [-0.1, 0.4]
friction = 0.3
health = 10
damage = {above = 3, factor = 10}
[[thrust]]
name = "push"
part = "left"
force = [30, 0]
player = "ann"
axis = "drive"
[[thrust]]
name = "pull"
part = "right"
force = [-30, 0]
player = "bob"
axis = "drive"
)";

/// Discs without loss, each of another player: both change by 10 m/s when they meet.
const char* const kDiscs = R"(
title = "Discs"
gravity = [0, 0]
duration = 4
buffer = 12
[[player]]
name = "ann"
vehicle = "a"
region = [[-1000, -1000], [-0.001, 1000]]
[[player]]
name = "bob"
vehicle = "b"
region = [[0, -1000], [1000, 1000]]
[[part]]
name = "a"
circle = 0.5
restitution = 1
friction = 0
position = [-5, 0]
velocity = [5, 0]
owner = "ann"
health = 100
damage = {above = 2, factor = 5}
[[part]]
name = "b"
circle = 0.5
restitution = 1
friction = 0
position = [5, 0]
velocity = [-5, 0]
owner = "bob"
health = 100
damage = {above = 2, factor = 5}
)";

ClusterConfig With(const char* text, const std::string& impair, std::int64_t seed) {
  ClusterConfig config;
  config.scene = "rules.toml";
  config.scene_text = text;
  config.impair = impair;
  config.seed = seed;
  return config;
}

float Health(Cluster& cluster, std::int32_t part) {
  return cluster.server().rules()->metadata().Get({kMetaPart, part, kMetaHealth});
}

TEST(PressedCrate, IsDestroyedBetweenTwoAuthoritiesOnlyIfTheOracleDestroysIt) {
  constexpr std::int32_t kCrate = 3;
  ClusterConfig truth = With(kPress, "perfect", 1);
  truth.mode = "oracle";
  Cluster oracle(truth);
  oracle.Run();
  ASSERT_GT(Health(oracle, kCrate), 0) << "the oracle's crate must live";
  for (const char* impair : {"demo", "delay=200ms"}) {
    for (const char* rule : {"retrospect", "rollback"}) {
      for (const int seed : SoakSeeds(1, 3)) {
        ClusterConfig config = With(kPress, impair, seed);
        config.reconcile = rule;
        Cluster cluster(config);
        cluster.Run();
        EXPECT_GT(Health(cluster, kCrate), 0) << impair << " " << rule << " seed " << seed;
      }
    }
  }
}

TEST(PressedCrate, AnImpactBetweenTwoAuthoritiesDamagesEachBodyOnce) {
  for (const char* impair : {"demo", "4g"}) {
    for (const int seed : SoakSeeds(1, 3)) {
      Cluster cluster(With(kDiscs, impair, seed));
      cluster.Run();
      // 10 m/s, of which 8 hurt, 5 each.
      for (const std::int32_t part : {std::int32_t{0}, std::int32_t{1}}) {
        EXPECT_NEAR(Health(cluster, part), 60, 12)
            << impair << " seed " << seed << " part " << part;
      }
      EXPECT_EQ(cluster.server().stats().dropped_implausible, 0) << impair << " seed " << seed;
    }
  }
}

TEST(PressedCrate, ForgedReportsAreCountedAndDamageNothing) {
  ClusterConfig config = With(kDiscs, "perfect", 1);
  int forged = 0;
  std::int64_t tick = 0;
  SentStates sent;
  config.client_net = [&](std::size_t client, std::unique_ptr<Net> net) -> std::unique_ptr<Net> {
    if (client != 0) return net;
    return std::make_unique<RewritingNet>(std::move(net), [&](std::int64_t, Bytes* message) {
      const States* const told = sent.In(*message);
      if (told == nullptr || tick < 20 || tick > 40) return true;
      const States& states = *told;
      ImpactReport report;
      report.tick = states.tick;
      report.revision = states.revision;
      // About bob's body; far off; and stronger than any nearby body could cause.
      const std::int32_t struck = static_cast<std::int32_t>(forged % 3 == 0 ? 1 : 0);
      report.id = {struck};
      report.epoch = {states.epoch.at(0)};
      report.by = {static_cast<std::int32_t>(forged % 3 == 1 ? 1 : -1)};
      report.x = {-5};
      report.y = {0};
      report.dv = {90};
      *message = Encode(report);
      ++forged;
      return true;
    });
  };
  Cluster cluster(config);
  while (cluster.server().tick() < 50) {
    cluster.RunToTick(cluster.server().tick() + 1);
    tick = cluster.server().tick();
  }
  EXPECT_GT(forged, 5);
  EXPECT_EQ(Health(cluster, 0), 100);
  EXPECT_EQ(Health(cluster, 1), 100);
  const Stats& stats = cluster.server().stats();
  EXPECT_GE(stats.dropped_right, forged / 3);
  EXPECT_GE(stats.dropped_implausible, forged / 3);
}

}  // namespace pressed_crate_test
}  // namespace seam
