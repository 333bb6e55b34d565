/// Inputs over a bad network: every change arrives, and what is held costs little.

#include <gtest/gtest.h>

#include "common/sync/input_source.h"
#include "tests/lab/cluster.h"

namespace seam {
namespace {

ClusterConfig With(const std::string& mode, const std::string& impair) {
  ClusterConfig config;
  config.scene = "crossing";
  config.mode = mode;
  config.impair = impair;
  config.duration_s = 6;
  return config;
}

TEST(InputSending, EveryChangeReachesTheServerAndTheOthersWithAThirdOfTheDatagramsLost) {
  for (const char* mode : {"buffer", "central"}) {
    SCOPED_TRACE(mode);
    ClusterConfig config = With(mode, "delay=40ms,jitter=10ms,loss=30%");
    config.drive = Drive::kBot;
    Cluster cluster(config);
    cluster.Run();
    constexpr int kAnn = 0;
    const std::int64_t end = cluster.server().tick() - 30;  // what is under way does not count
    ASSERT_GT(end, 200);
    int changes = 0;
    // What each peer has: the server, and bob's client.
    InputTrack servers = cluster.server().replica().inputs(kAnn);
    InputTrack bobs = cluster.client(1)->replica()->inputs(kAnn);
    for (std::int64_t tick = 60; tick < end; ++tick) {
      const Input truth = BotInput(config.seed, kAnn, tick, 60);
      EXPECT_TRUE(servers.At(tick) == truth) << tick;
      EXPECT_TRUE(bobs.At(tick) == truth) << tick;
      if (truth == BotInput(config.seed, kAnn, tick - 1, 60)) continue;
      ++changes;
      EXPECT_TRUE(servers.knows(tick) && bobs.knows(tick)) << tick;
    }
    EXPECT_GT(changes, 5);
  }
}

TEST(InputSending, AChangeIsOnItsWayInItsOwnTick) {
  // 40 ms one way are 2.4 ticks: the server knows ann's change of tick t when it has made tick
  // t + 3, whether her states went out in t or not.
  ClusterConfig config = With("buffer", "delay=40ms");
  config.drive = Drive::kBot;
  Cluster cluster(config);
  int changes = 0;
  for (std::int64_t tick = 30; tick < 300; ++tick) {
    cluster.RunToTick(tick);
    const std::int64_t then = tick - 3;
    const Input truth = BotInput(config.seed, 0, then, 60);
    if (truth == BotInput(config.seed, 0, then - 1, 60)) continue;
    ++changes;
    EXPECT_TRUE(cluster.server().replica().inputs(0).knows(then)) << then;
  }
  EXPECT_GT(changes, 4);
}

TEST(InputSending, AHeldInputCostsLittle) {
  // Mode central: a client sends nothing but inputs, pings and acknowledgements.
  Cluster cluster(With("central", "delay=40ms"));
  cluster.RunToTick(120);
  const std::int64_t before = cluster.client(1)->stats().bytes_out;
  cluster.RunToTick(300);
  const double bytes_per_s =
      static_cast<double>(cluster.client(1)->stats().bytes_out - before) / 3.0;
  std::printf("[          ] %.0f bytes/s by a client that holds its input\n", bytes_per_s);
  EXPECT_LT(bytes_per_s, 2000) << "a message of 16 ticks in each tick was 7700";
}

}  // namespace
}  // namespace seam
