/// The real server and clients in one process and in virtual time: collisions in each mode, changes
/// of authority, and runs that repeat bit for bit.

#include "client/embed/cluster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "common/measure/measure.h"
#include "common/net/loose_datagram.h"

namespace seam {
namespace cluster_test {

Measures MeasureRun(const ClusterConfig& config) {
  const Recording recording = RunCluster(config);
  return Measure(recording, ComputeOracle(recording));
}

ClusterConfig With(const std::string& scene, const std::string& mode,
                   const std::string& reconcile = "") {
  ClusterConfig config;
  config.scene = scene;
  config.mode = mode;
  config.reconcile = reconcile;
  return config;
}

TEST(Cluster, EveryPeerInModeOracleShowsTheSameBits) {
  const Recording recording = RunCluster(With("crossing", "oracle"));
  const Measures m = Measure(recording, ComputeOracle(recording));
  EXPECT_EQ(m.error_max_m, 0);
  ASSERT_TRUE(m.rebound.has_value());
  EXPECT_NEAR(*m.rebound, 1, 1e-9);
  ASSERT_EQ(recording.views.size(), 3u);
  for (const auto& [peer, views] : recording.views) {
    EXPECT_GT(views.size(), 300u) << "peer " << peer;
  }
}

TEST(Cluster, StrictShowsTheRubberWallAndBufferDoesNot) {
  const Measures strict = MeasureRun(With("crossing", "strict"));
  // One run hangs on when which datagram comes: of 40 seeds of 0.18.2 36 gave .03 to .07, the
  // others .41 to 1.09.
  std::vector<double> rebounds;
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    ClusterConfig config = With("crossing", "strict");
    config.seed = seed;
    const Measures m = MeasureRun(config);
    ASSERT_TRUE(m.rebound.has_value()) << "seed " << seed;
    rebounds.push_back(*m.rebound);
  }
  std::nth_element(rebounds.begin(), rebounds.begin() + 4, rebounds.end());
  EXPECT_LT(rebounds[4], 0.2) << "the artifact must be reproduced";
  for (const char* cure : {"fade", "retrospect"}) {
    const Measures m = MeasureRun(With("crossing", "buffer", cure));
    ASSERT_TRUE(m.rebound.has_value()) << cure;
    EXPECT_GT(*m.rebound, 0.9) << cure;
    EXPECT_LT(*m.rebound, 1.1) << cure;
    EXPECT_LT(m.error_rms_m, strict.error_rms_m / 10) << cure;
  }
}

TEST(Cluster, RetrospectHasTheLeastErrorAndNoMoreStutterThanFade) {
  for (const char* scene : {"crossing", "cradle"}) {
    const Measures ours = MeasureRun(With(scene, "buffer", "retrospect"));
    for (const char* other : {"snap", "interleave", "compensated", "fade"}) {
      const Measures m = MeasureRun(With(scene, "buffer", other));
      EXPECT_LT(ours.error_rms_m, m.error_rms_m) << scene << " " << other;
      if (std::string(other) == "fade") {
        EXPECT_LE(ours.stutter_mps2, m.stutter_mps2) << scene;
      }
    }
  }
}

TEST(Cluster, TheStackStandsForAMinuteAfterTheShove) {
  for (const char* network : {"oneway100", "oneway200"}) {
    for (const char* rule : {"compensated", "fade", "retrospect"}) {
      ClusterConfig config = With("stack", "buffer", rule);
      config.impair = network;
      config.duration_s = 65;
      const Recording recording = RunCluster(config);
      const Oracle oracle = ComputeOracle(recording);
      for (const auto& [peer, views] : recording.views) {
        const View& last = views.rbegin()->second;
        ASSERT_GT(last.tick, 64 * 60);
        for (std::size_t i = 0; i < last.id.size(); ++i) {
          const auto truth = oracle.At(last.tick, last.id[i]);
          ASSERT_TRUE(truth.has_value());
          EXPECT_NEAR(last.y[i], truth->position.y(), 0.05)
              << network << " " << rule << " peer " << peer << " box " << i;
          EXPECT_NEAR(last.x[i], truth->position.x(), 0.25) << network << " " << rule;
        }
      }
    }
  }
}

TEST(Cluster, CentralPredictsItsOwnVehicleToTheServersState) {
  const Recording recording = RunCluster(With("crossing", "central"));
  const Oracle oracle = ComputeOracle(recording);
  const Scene scene = ParseScene(recording.room.scene_text, "crossing.toml");
  // Before the collision, ann's prediction of her car equals the oracle.
  const PartId car = scene.players[0].vehicle;
  int looked = 0;
  for (const auto& [tick, view] : recording.views.at(1)) {
    if (tick < 30 || tick > 120) continue;
    for (std::size_t i = 0; i < view.id.size(); ++i) {
      if (view.id[i] != car) continue;
      const auto truth = oracle.At(tick, car);
      ASSERT_TRUE(truth.has_value());
      EXPECT_NEAR(view.x[i], truth->position.x(), 0.1) << tick;
      ++looked;
    }
  }
  EXPECT_GT(looked, 80);
}

/// A recorder that keeps nothing but a hash of all it is given.
std::uint64_t DigestOf(const ClusterConfig& config) {
  const Recording r = RunCluster(config);
  std::uint64_t hash = Fnv1a("", 0);
  for (const auto& [peer, views] : r.views) {
    for (const auto& [tick, view] : views) {
      const Bytes bytes = Encode(view);
      hash = Fnv1a(bytes.data(), bytes.size(), hash);
    }
  }
  for (const States& states : r.states) {
    const Bytes bytes = Encode(states);
    hash = Fnv1a(bytes.data(), bytes.size(), hash);
  }
  for (const auto& [peer, stats] : r.stats) {
    for (const Stats& s : stats) {
      const Bytes bytes = Encode(s);
      hash = Fnv1a(bytes.data(), bytes.size(), hash);
    }
  }
  return hash;
}

TEST(Cluster, TheSameSeedGivesTheSameBytesAndAnotherSeedDiffers) {
  for (const char* mode : {"central", "strict", "buffer"}) {
    ClusterConfig config = With("crossing", mode);
    config.impair = "4g";
    const std::uint64_t first = DigestOf(config);
    EXPECT_EQ(first, DigestOf(config)) << mode;
    config.seed = 2;
    EXPECT_NE(first, DigestOf(config)) << mode;
  }
}

TEST(Cluster, BotsDriveTheSameInEveryRun) {
  ClusterConfig config = With("crossing", "buffer", "retrospect");
  config.drive = Drive::kBot;
  EXPECT_EQ(DigestOf(config), DigestOf(config));
}

TEST(Cluster, AfterQuietAllPeersShowTheSameBitsUnderThirtyPercentLoss) {
  for (const char* rule : {"fade", "retrospect"}) {
    ClusterConfig config = With("stack", "buffer", rule);
    config.impair = "delay=50ms,jitter=10ms,loss=30%";
    config.duration_s = 40;
    const Recording recording = RunCluster(config);
    const Measures m = Measure(recording, ComputeOracle(recording));
    EXPECT_TRUE(m.rest_ticks.has_value()) << rule;
  }
}

TEST(Cluster, GarbageAndForeignDatagramsAreCountedAndTheRoomRunsOn) {
  ClusterConfig config = With("crossing", "buffer", "retrospect");
  Cluster quiet(config);
  quiet.Run();
  Cluster cluster(config);
  const std::unique_ptr<Net> hostile = cluster.Attach(Address{0x7f000001, 9});
  Random random(5);
  std::int64_t sent = 0;
  cluster.each_instant = [&] {
    for (int i = 0; i < 3; ++i, ++sent) {
      Bytes junk(1 + random.Next() % 1200);
      for (std::uint8_t& b : junk) b = static_cast<std::uint8_t>(random.Next());
      hostile->Send(cluster.server_address(), junk);
    }
    hostile->Flush();
  };
  cluster.Run();
  EXPECT_GT(sent, 1000);
  EXPECT_GT(cluster.server().stats().dropped_malformed, sent * 9 / 10);
  EXPECT_EQ(cluster.server().tick(), quiet.server().tick());
  // It does not change the players' views.
  const Recording& a = quiet.recording();
  const Recording& b = cluster.recording();
  const double calm = Measure(a, ComputeOracle(a)).error_rms_m;
  EXPECT_LT(Measure(b, ComputeOracle(b)).error_rms_m, 2 * calm + 0.01);
}

TEST(Cluster, ForgedHellosDoNotKeepAPlayerOut) {
  Cluster cluster(With("cradle", "buffer", "retrospect"));
  cluster.RunToTick(60);
  cluster.Kill(1);
  // A hello a virtual instant, each as if from another machine that never answers.
  std::vector<std::unique_ptr<Net>> forged;
  cluster.each_instant = [&] {
    const auto n = static_cast<std::uint32_t>(forged.size());
    if (n >= 4000) return;
    forged.push_back(cluster.Attach(Address{0x0a000000 + n, 1000}));
    Hello hello;
    hello.name = "forged" + std::to_string(n);
    forged.back()->Send(cluster.server_address(),
                        LooseDatagram(1 + n, Encode(hello), kHandshakeBytes));
    forged.back()->Flush();
  };
  cluster.RunToTick(240);
  cluster.Revive(1);
  cluster.RunToTick(240 + 60 * 8);
  EXPECT_GT(forged.size(), 300u);
  EXPECT_TRUE(cluster.client(1)->running());
  EXPECT_EQ(cluster.client(1)->peer(), 2);
  EXPECT_TRUE(cluster.client(0)->running());
  EXPECT_EQ(cluster.server().client_count(), 2) << "the forged ones are no sessions";
}

TEST(Cluster, TheFloorSeparatesAChaoticSceneFromAnOrderlyOne) {
  const Recording orderly = RunCluster(With("cradle", "oracle"));
  EXPECT_LT(ErrorFloor(orderly, ComputeOracle(orderly)), 1e-4);
  EXPECT_GT(ErrorFloor(orderly, ComputeOracle(orderly)), 0);
  const Recording chaotic = RunCluster(With("wall", "oracle"));
  EXPECT_GT(ErrorFloor(chaotic, ComputeOracle(chaotic)), 0.01);
  EXPECT_GT(ErrorFloor(orderly, ComputeOracle(orderly), kWireNudge), kWireNudge / 30);
  EXPECT_LT(ErrorFloor(orderly, ComputeOracle(orderly), kWireNudge), 100 * kWireNudge);
}

OracleOptions Nudged(int body) {
  OracleOptions options;
  options.nudged_body = body;
  return options;
}

TEST(Cluster, TheFloorsNudgeIsNotLostInRoundingFarFromTheOrigin) {
  const Recording recording = RunCluster(With("crossing", "oracle"));
  const Oracle oracle = ComputeOracle(recording);
  for (int body = 0; body < static_cast<int>(oracle.ids.size()); ++body) {
    const Oracle nudged = ComputeOracle(recording, Nudged(body));
    bool differs = false;
    for (std::int64_t tick = 1; tick < 60; ++tick) {
      const PartId id = oracle.ids[static_cast<std::size_t>(body)];
      differs = differs || nudged.At(tick, id)->position != oracle.At(tick, id)->position;
    }
    EXPECT_TRUE(differs) << "body " << body;
  }
}

TEST(Cluster, VirtualTimeIsFasterThanRealTime) {
  const auto begin = std::chrono::steady_clock::now();
  const Recording recording = RunCluster(With("crossing", "buffer", "retrospect"));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  const double simulated = static_cast<double>(recording.last_tick) / 60;
  std::printf("[          ] %.1f s simulated in %.2f s: %.0f x real time\n", simulated,
              took.count(), simulated / took.count());
  EXPECT_GT(simulated, 5);
}

}  // namespace cluster_test
}  // namespace seam
