/// Clients pack what they send as the server does; a receiver that cannot read a message says so,
/// and reads again a round trip later.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "client/embed/cluster.h"
#include "common/codec/codec.h"
#include "tests/support/path/rewriting_net.h"

namespace seam {
namespace packed_uplink_test {

constexpr std::int64_t kSpoiledAtUs = 4000000;

/// Makes packed states unreadable, once: the datagram is acknowledged all the same.
struct Spoiler {
  bool done = false;
  void Spoil(std::int64_t now_us, Bytes* message) {
    const AnyMessage any = Decode(*message);
    const auto* packed = std::get_if<PackedStates>(&any);
    if (done || packed == nullptr || now_us < kSpoiledAtUs) return;
    done = true;
    PackedStates spoiled = *packed;
    spoiled.data.resize(3);
    *message = Encode(spoiled);
  }
};

ClusterConfig Crossing(const std::string& impair) {
  ClusterConfig config;
  config.scene = "crossing";
  config.impair = impair;
  config.drive = Drive::kBot;
  config.duration_s = 7;
  return config;
}

TEST(PackedUplink, TheServerReadsAgainAfterAMessageThatItCouldNotRead) {
  for (const char* impair : {"delay=40ms", "4g"}) {
    SCOPED_TRACE(impair);
    ClusterConfig config = Crossing(impair);
    Spoiler spoiler;
    config.client_net = [&](std::size_t client, std::unique_ptr<Net> net) {
      if (client != 0) return net;
      return std::unique_ptr<Net>(
          std::make_unique<RewritingNet>(std::move(net), [&](std::int64_t now_us, Bytes* message) {
            spoiler.Spoil(now_us, message);
            return true;
          }));
    };
    Cluster cluster(config);
    cluster.Run();
    ASSERT_TRUE(spoiler.done);
    const std::int64_t refused = cluster.server().stats().dropped_malformed;
    EXPECT_GE(refused, 1);
    EXPECT_LE(refused, 20) << "those under way in two round trips";
    std::int64_t newest = 0;
    for (const States& states : cluster.recording().states) {
      if (states.peer == 1) newest = std::max(newest, states.tick);
    }
    EXPECT_GT(newest, cluster.server().tick() - 60) << "its states count to the end";
  }
}

TEST(PackedUplink, AClientReadsAgainAfterAMessageThatItCouldNotRead) {
  for (const char* mode : {"buffer", "central"}) {
    SCOPED_TRACE(mode);
    ClusterConfig config = Crossing("delay=40ms");
    config.mode = mode;
    Spoiler spoiler;
    config.client_net = [&](std::size_t client, std::unique_ptr<Net> net) {
      if (client != 0) return net;
      auto rewriting =
          std::make_unique<RewritingNet>(std::move(net), [](std::int64_t, Bytes*) { return true; });
      rewriting->rewrite_received = [&](std::int64_t now_us, Bytes* message) {
        spoiler.Spoil(now_us, message);
      };
      return std::unique_ptr<Net>(std::move(rewriting));
    };
    Cluster cluster(config);
    cluster.Run();
    ASSERT_TRUE(spoiler.done);
    EXPECT_GE(cluster.client(0)->stats().dropped_malformed, 1);
    EXPECT_LE(cluster.client(0)->stats().dropped_malformed, 20);
  }
}

/// A room of `side` m with 196 discs that never rest, all ann's; she sends each of them in each
/// send, because the server does not follow them.
std::string Discs(double side) {
  const std::string gap = std::to_string(side / 14);
  return R"(
gravity = [0, 0]
duration = 6
server_follow = 0
[solver]
sleep = false
[[player]]
name = "ann"
region = [[-1000, -1000], [1000, 1000]]
[[part]]
name = "disc"
circle = 0.4
velocity = [1.5, 0.7]
spin = 0.6
repeat = {count = [14, 14], step = [)" +
         gap + ", " + gap + "]}\n";
}

/// Returns the bytes for each state that the client sends, with everything else that it sends.
double BytesEach(double side) {
  ClusterConfig config;
  config.scene = "discs";
  config.scene_text = Discs(side);
  config.impair = "demo";
  Cluster cluster(config);
  cluster.RunToTick(120);
  const std::int64_t before = cluster.client(0)->stats().bytes_out;
  const std::size_t first = cluster.recording().states.size();
  cluster.RunToTick(300);
  std::size_t told = 0;
  for (std::size_t i = first; i < cluster.recording().states.size(); ++i) {
    told += cluster.recording().states[i].peer == 1 ? cluster.recording().states[i].id.size() : 0;
  }
  EXPECT_GT(told, 1000u);
  EXPECT_EQ(cluster.server().stats().dropped_budget, 0);
  const auto sent = static_cast<double>(cluster.client(0)->stats().bytes_out - before);
  return sent / static_cast<double>(told);
}

TEST(PackedUplink, AWideRoomCostsItsHolderNoMoreThanANarrowOne) {
  const double narrow = BytesEach(20), wide = BytesEach(400);
  std::printf("[          ] %.2f and %.2f bytes for each state\n", narrow, wide);
  EXPECT_LT(narrow, 6) << "22 as states_t";
  EXPECT_LT(wide, 1.2 * narrow + 0.5) << "55 as states_t: a message for each two bodies";
}

}  // namespace packed_uplink_test
}  // namespace seam
