/// Authority over lossy networks: a mechanism never has two authorities at once.

#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "client/embed/cluster.h"
#include "common/measure/measure.h"
#include "tests/support/authority_watch.h"
#include "tests/support/soak.h"

namespace seam {
namespace authority_test {

/// Two pendulums that swing over the seam: authority must follow.
const char* const kShuttle = R"(
title = "Shuttle"
duration = 20
buffer = 4
[[part]]
name = "beam"
box = [1, 1]
position = [0, 20]
anchored = true
[[part]]
name = "ball"
circle = 0.5
position = [-9, 8]
[[part]]
name = "other"
circle = 0.4
position = [8, 12]
group = -1
[[joint]]
name = "rope"
kind = "distance"
a = "beam"
b = "ball"
anchor_a = [0, 20]
anchor_b = [-9, 8]
[[joint]]
name = "other-rope"
kind = "distance"
a = "beam"
b = "other"
anchor_a = [0, 20]
anchor_b = [8, 12]
[[player]]
name = "ann"
region = [[-100, -100], [-0.001, 100]]
[[player]]
name = "bob"
region = [[0, -100], [100, 100]]
)";

ClusterConfig Cradle() {
  ClusterConfig config;
  config.scene = "cradle";
  config.reconcile = "retrospect";
  return config;
}

TEST(Authority, ThereAreNeverTwoAuthoritiesUnderTwentyPercentLoss) {
  ClusterConfig config;
  config.scene = "shuttle.toml";
  config.scene_text = kShuttle;
  config.impair = "delay=50ms,jitter=10ms,loss=20%";
  for (const int seed : SoakSeeds(1, 5)) {
    config.seed = seed;
    Cluster cluster(config);
    AuthorityWatch watcher;
    cluster.each_instant = [&] { watcher.Look(cluster); };
    cluster.Run();
    const Measures m = Measure(cluster.recording(), ComputeOracle(cluster.recording()));
    EXPECT_GT(m.handovers, 4) << "nothing changed hands: the test would show nothing";
    EXPECT_EQ(watcher.several, 0) << "seed " << seed;
    EXPECT_EQ(watcher.two_holders_of_an_epoch, 0) << "seed " << seed;
    EXPECT_EQ(watcher.two_named_in_an_epoch, 0) << "seed " << seed;
    // While a hand-over is under way nobody holds it, and everybody simulates it on.
    EXPECT_LT(static_cast<double>(watcher.none) / static_cast<double>(watcher.instants), 0.2);
    EXPECT_GT(watcher.one, 0);
  }
}

TEST(Authority, TheServersLedgerNamesExactlyOneAuthorityAtEveryTick) {
  ClusterConfig config;
  config.scene = "shuttle.toml";
  config.scene_text = kShuttle;
  config.impair = "delay=50ms,jitter=10ms,loss=20%";
  Cluster cluster(config);
  cluster.Run();
  // Checks the published grants: a change of authority always has a greater epoch, and the server's
  // view shows one authority per body at each tick.
  std::map<int, std::pair<int, int>> last;  // mechanism -> epoch, authority
  int changes = 0;
  for (const Grants& g : cluster.recording().grants) {
    for (std::size_t i = 0; i < g.mechanism.size(); ++i) {
      const auto it = last.find(g.mechanism[i]);
      if (it != last.end()) {
        EXPECT_GE(g.epoch[i], it->second.first);
        if (g.authority[i] != it->second.second) {
          EXPECT_GT(g.epoch[i], it->second.first);
          ++changes;
        }
      }
      last[g.mechanism[i]] = {g.epoch[i], g.authority[i]};
    }
  }
  EXPECT_GT(changes, 4);
  for (const auto& [tick, view] : cluster.recording().views.at(0)) {
    for (std::size_t i = 0; i < view.id.size(); ++i) {
      EXPECT_GE(view.authority[i], 0);
      EXPECT_LE(view.authority[i], 2);
    }
  }
}

TEST(Authority, AVanishedClientsMechanismsGoBackAndItCanRejoin) {
  ClusterConfig config = Cradle();
  config.impair = "demo";
  Cluster cluster(config);
  AuthorityWatch watcher;
  cluster.each_instant = [&] { watcher.Look(cluster); };
  cluster.RunToTick(120);
  const auto held_by = [&](int peer) {
    int count = 0;
    const AuthorityTable& table = cluster.server().replica().authority();
    for (int m = 0; m < table.count(); ++m) count += table.at(m).authority == peer ? 1 : 0;
    return count;
  };
  const int before = held_by(2);
  ASSERT_GT(before, 0);
  cluster.Kill(1);
  cluster.RunToTick(120 + 60 * 5);
  EXPECT_EQ(held_by(2), 0);
  EXPECT_EQ(held_by(0), before);
  EXPECT_EQ(cluster.server().client_count(), 1);
  cluster.Revive(1);
  cluster.RunToTick(120 + 60 * 9);
  EXPECT_EQ(held_by(2), before) << "ann is back: what is hers is hers again";
  EXPECT_EQ(cluster.client(1)->peer(), 2);
  EXPECT_TRUE(cluster.client(1)->running());
  EXPECT_EQ(watcher.several, 0);
}

TEST(Authority, ACutOfFiveSecondsEndsInARejoinWithoutTwoAuthorities) {
  ClusterConfig config = Cradle();
  Cluster cluster(config);
  AuthorityWatch watcher;
  cluster.each_instant = [&] { watcher.Look(cluster); };
  cluster.RunToTick(120);
  cluster.server_net().Cut(true);
  cluster.RunToTick(120 + 60 * 5);
  EXPECT_EQ(cluster.server().client_count(), 0);
  cluster.server_net().Cut(false);
  cluster.RunToTick(120 + 60 * 12);
  EXPECT_EQ(cluster.server().client_count(), 2);
  for (int c = 0; c < 2; ++c) {
    EXPECT_TRUE(cluster.client(c)->running());
    EXPECT_GE(cluster.client(c)->rejoins(), 1);
  }
  EXPECT_EQ(watcher.several, 0);
}

}  // namespace authority_test
}  // namespace seam
