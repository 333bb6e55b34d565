/// Rooms in which peers send inputs alone: lockstep and rollback of inputs.

#include <gtest/gtest.h>

#include <cmath>

#include "client/embed/cluster.h"
#include "common/measure/measure.h"
#include "common/measure/screen/input_delays.h"
#include "server/input_room.h"

namespace seam {
namespace inputs_only_test {

ClusterConfig With(const std::string& mode, const std::string& impair = "demo") {
  ClusterConfig config;
  config.scene = "crossing";
  config.mode = mode;
  config.impair = impair;
  config.drive = Drive::kBot;
  config.duration_s = 5;
  return config;
}

Measures MeasuresOf(Cluster& cluster) {
  const Recording& recording = cluster.recording();
  return Measure(recording, ComputeOracle(recording, JudgeOf(recording.room)));
}

const Replica& ReplicaOf(const Cluster& cluster, int client) {
  return *cluster.client(client)->replica();
}

/// Expects the same bits in all worlds, at the newest whole second that all know.
void ExpectOneWorld(const Cluster& cluster) {
  const Replica& server = cluster.server().replica();
  std::int64_t tick = server.newest_past();
  for (int i = 0; i < cluster.client_count(); ++i) {
    ASSERT_TRUE(cluster.client(i)->running()) << i;
    tick = std::min(tick, cluster.client(i)->replica()->newest_past());
  }
  const std::optional<std::uint64_t> hash = server.PastHash(tick);
  ASSERT_TRUE(hash) << tick;
  for (int i = 0; i < cluster.client_count(); ++i) {
    EXPECT_EQ(cluster.client(i)->replica()->PastHash(tick), hash) << i << ", tick " << tick;
  }
  EXPECT_EQ(cluster.server().input_room()->parted(), 0);
}

TEST(InputsOnly, LockstepShowsTheOraclesBitsOnEveryScreen) {
  for (const char* mode : {"lockstep", "lockstep-adaptive"}) {
    SCOPED_TRACE(mode);
    Cluster cluster(With(mode));
    cluster.Run();
    ExpectOneWorld(cluster);
    const Measures measures = MeasuresOf(cluster);
    EXPECT_GT(measures.compared, 1000);
    EXPECT_EQ(measures.error_max_m, 0);
    EXPECT_EQ(cluster.ticks_stepped_again(), 0);
    EXPECT_EQ(cluster.recording().states.size(), 0u) << "nobody sends states";
  }
}

TEST(InputsOnly, LockstepWaitsWhereItsDelayIsShorterThanTheWay) {
  Cluster near(With("lockstep", "delay=20ms")), far(With("lockstep", "delay=150ms"));
  near.Run();
  far.Run();
  ExpectOneWorld(far);
  EXPECT_EQ(near.server().speed_ppm(), kFullSpeedPpm);
  EXPECT_LT(far.server().speed_ppm(), kFullSpeedPpm) << "300 ms between players, 133 of delay";
  EXPECT_GT(far.now_us(), near.now_us() + 1000000);
}

TEST(InputsOnly, AnAdaptedDelayFitsTheWay) {
  ClusterConfig config = With("lockstep-adaptive", "delay=100ms,jitter=5ms,loss=1%");
  config.duration_s = 10;
  Cluster cluster(config);
  cluster.Run();
  ExpectOneWorld(cluster);
  const InputDelays delays(cluster.recording());
  const int newest = delays.Of(0, cluster.recording().last_tick);
  EXPECT_GE(newest, 12) << "200 ms between players";
  EXPECT_LE(newest, 20);
  EXPECT_EQ(cluster.server().speed_ppm(), kFullSpeedPpm);
}

TEST(InputsOnly, RollbackOfInputsGoesBackAndEndsInOneWorld) {
  Cluster cluster(With("ggpo"));
  cluster.Run();
  ExpectOneWorld(cluster);
  EXPECT_GT(cluster.ticks_stepped_again(), 0);
  EXPECT_EQ(cluster.server().replica().ticks_stepped_again(), 0) << "it steps complete ticks";
  const Measures measures = MeasuresOf(cluster);
  EXPECT_EQ(measures.error_server_m, 0);
  EXPECT_LT(measures.error_others_m.value_or(1e9), 2);
}

TEST(InputsOnly, RollbackOfInputsPredictsEightTicksAtMost) {
  Cluster cluster(With("ggpo", "delay=150ms"));
  std::int64_t most = 0;
  cluster.each_instant = [&] {
    for (int i = 0; i < 2; ++i) {
      if (cluster.client(i) == nullptr || !cluster.client(i)->running()) continue;
      const Replica& replica = *cluster.client(i)->replica();
      std::int64_t complete = INT64_MAX;
      for (int p = 0; p < 2; ++p) complete = std::min(complete, replica.inputs(p).newest());
      most = std::max(most, replica.tick() - complete);
    }
  };
  cluster.Run();
  EXPECT_EQ(most, 8);
  ExpectOneWorld(cluster);
}

TEST(InputsOnly, APlayerWhoComesLateBeginsWithTheSameBits) {
  for (const char* mode : {"lockstep", "lockstep-adaptive", "ggpo"}) {
    SCOPED_TRACE(mode);
    Cluster cluster(With(mode));
    cluster.RunToTick(100);
    cluster.Leave(1);
    cluster.RunToTick(160);
    EXPECT_EQ(cluster.server().player_count(), 1);
    cluster.Revive(1);
    cluster.RunToTick(300);
    ExpectOneWorld(cluster);
    EXPECT_FALSE(cluster.client(1)->replica()->inputs(1).At(290) == Input{} &&
                 cluster.client(1)->replica()->inputs(1).At(250) == Input{} &&
                 cluster.client(1)->replica()->inputs(1).At(270) == Input{})
        << "the player drives again";
    EXPECT_EQ(MeasuresOf(cluster).error_server_m, 0);
  }
}

TEST(InputsOnly, AJoinerOfALargeRoomBeginsWithTheSameBits) {
  ClusterConfig config = With("lockstep");
  config.scene = "gas";  // 200 discs that never rest
  config.duration_s = 10;
  Cluster cluster(config);
  cluster.RunToTick(200);
  cluster.Leave(1);
  cluster.RunToTick(230);
  cluster.Revive(1);
  cluster.RunToTick(500);
  ExpectOneWorld(cluster);
}

TEST(InputsOnly, TheRoomStandsForAPlayerWhoStallsUntilThatPlayerIsDropped) {
  for (const char* mode : {"lockstep", "ggpo"}) {
    SCOPED_TRACE(mode);
    Cluster cluster(With(mode, "delay=20ms"));
    cluster.RunToTick(100);
    cluster.Pause(1, true);
    const std::int64_t stalled_us = cluster.now_us();
    cluster.RunToTick(150);
    EXPECT_GT(cluster.now_us() - stalled_us, 3000000) << "the others wait";
    EXPECT_EQ(cluster.server().player_count(), 1);
    cluster.Pause(1, false);
    cluster.Kill(1);
    cluster.Revive(1);
    cluster.RunToTick(400);
    ExpectOneWorld(cluster);
  }
}

TEST(InputsOnly, EditsThatPhysicsFindsAreAppliedInTheSameTicks) {
  for (const char* mode : {"lockstep", "ggpo"}) {
    SCOPED_TRACE(mode);
    ClusterConfig config = With(mode);
    config.scene = "gluehouse";
    config.duration_s = 6;
    Cluster cluster(config);
    cluster.Run();
    const Replica& server = cluster.server().replica();
    EXPECT_GT(server.revision(), 0);
    EXPECT_EQ(cluster.server().input_room()->parted(), 0);
    for (int i = 0; i < cluster.client_count(); ++i) {
      ASSERT_TRUE(cluster.client(i)->running());
      EXPECT_EQ(cluster.client(i)->replica()->world().composition().hash,
                server.world().composition().hash);
    }
  }
}

TEST(InputsOnly, AWorldThatHasPartedIsFoundAndReplaced) {
  Cluster cluster(With("lockstep"));
  cluster.RunToTick(60);
  // As a bug would do it.
  const_cast<World&>(ReplicaOf(cluster, 0).world()).Write(0, BodyState{});
  cluster.RunToTick(900);
  EXPECT_EQ(cluster.server().input_room()->parted(), 1);
  EXPECT_EQ(cluster.client(0)->rejoins(), 1) << "it had to leave, and came back";
  EXPECT_EQ(cluster.client(1)->rejoins(), 0);
  ASSERT_TRUE(cluster.client(0)->running());
  const std::int64_t tick =
      std::min(ReplicaOf(cluster, 0).newest_past(), cluster.server().replica().newest_past());
  EXPECT_EQ(ReplicaOf(cluster, 0).PastHash(tick), cluster.server().replica().PastHash(tick));
}

}  // namespace inputs_only_test
}  // namespace seam
