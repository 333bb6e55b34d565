/// Inputs over a bad network: every change arrives, and held inputs cost little.

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "client/embed/cluster.h"
#include "common/sync/inputs/input_source.h"
#include "server/interest/send_queue.h"

namespace seam {
namespace input_sending_test {

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
    // The inputs known to the server and to bob's client.
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

TEST(InputSending, AChangeIsSentInItsOwnTick) {
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

/// Discs in a row in space, each with a player who moves its surface.
std::string Row(int players) {
  const std::string repeat = "repeat = {count = " + std::to_string(players) + ", step = [4, 0]}\n";
  return R"(
gravity = [0, 0]
duration = 8
[[player]]
name = "p"
vehicle = "disc.0"
)" + repeat +
         R"(
[[part]]
name = "disc"
circle = 0.5
owners = ["p-*"]
conveyor = {player = "p-0", speed = 3}
)" + repeat;
}

/// Bytes a second that a client gets of a full room in which all predict all.
double BytesInFullRoom(int players) {
  ClusterConfig config = With("central", "delay=40ms,jitter=5ms");
  config.scene = "row";
  config.scene_text = Row(players);
  config.drive = Drive::kBot;
  Cluster cluster(config);
  cluster.RunToTick(90);
  const std::int64_t before = cluster.client(0)->stats().bytes_in;
  cluster.RunToTick(270);
  // Every other player's inputs have arrived: the count does not profit from omitted ones.
  const std::int64_t end = cluster.server().tick() - 12;
  for (int player = 1; player < players; ++player) {
    EXPECT_TRUE(cluster.client(0)->replica()->inputs(player).At(end) ==
                BotInput(config.seed, player, end, 60))
        << player;
  }
  return static_cast<double>(cluster.client(0)->stats().bytes_in - before) / 3.0;
}

TEST(InputSending, InputsOfManyPlayersTakeASmallShareOfTheBudget) {
  const double few = BytesInFullRoom(4), many = BytesInFullRoom(40);
  std::printf("[          ] %.0f bytes/s to a client of 4, %.0f of 40\n", few, many);
  EXPECT_LT(many, 0.2 * kClientBytesPerS) << "36 more, 60 times a second: 177 kB/s as inputs_t";
}

}  // namespace input_sending_test
}  // namespace seam
