/// Blasted pieces stay in the world over a bad network, at every holder.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/soak.h"
#include "tests/support/soak/fault_runner.h"
#include "tests/support/two_sides.h"

namespace seam {
namespace lost_pieces_test {

/// Everything of `battlefield` lies on ground at y = 0, which is a line.
constexpr float kLost = -1;

/// Holders with a piece below the ground, by ticks and pieces.
int Lost(std::uint64_t seed, const char* rule) {
  FaultPlan plan = DrawFaults(seed, {{"battlefield"}, 20});
  plan.config.mode = "buffer";
  plan.config.predict = "";
  plan.config.reconcile = rule;
  plan.config.impair = "delay=80ms,jitter=15ms,loss=30%";
  plan.config.drive = Drive::kBot;
  FaultRunner faults(plan);
  Cluster cluster(faults.Config());
  int lost = 0;
  std::int64_t looked = -1;
  const auto look = [&](int self, const Replica& replica) {
    const World& world = replica.world();
    for (int body = 0; body < world.body_count(); ++body) {
      if (replica.authority().at(world.mechanism(body)).authority != self) continue;
      lost += world.Read(body).position.y() < kLost ? 1 : 0;
    }
  };
  cluster.each_instant = [&] {
    faults.Act(cluster);
    if (!cluster.server().started() || cluster.server().tick() == looked) return;
    looked = cluster.server().tick();
    look(0, cluster.server().replica());
    for (int c = 0; c < cluster.client_count(); ++c) {
      const Client* client = cluster.client(c);
      if (client == nullptr || !client->running()) continue;
      look(client->peer(), *client->replica());
    }
  };
  cluster.Run();
  EXPECT_GE(cluster.server().replica().revision(), 1) << "something was blown up";
  return lost;
}

/// Corrections extrapolated by their velocity took pieces through the ground, where they fell for
/// ever once that peer got the authority: 5 of 60 seeds, these among them.
TEST(LostPiecesCluster, NoCorrectionTakesAPieceThroughTheGround) {
  for (const std::uint64_t seed : {39u, 42u, 45u, 46u}) {
    EXPECT_EQ(Lost(seed, "retrospect"), 0) << "seed " << seed;
  }
  for (const int seed : SoakSeeds(1, 1)) {
    for (const char* rule : {"retrospect", "fade", "rollback"}) {
      EXPECT_EQ(Lost(static_cast<std::uint64_t>(seed), rule), 0) << rule << ", seed " << seed;
    }
  }
}

/// Four posts on the left, each blown apart at its foot by two charges in turn, N s/m.
std::string Posts(double impulse) {
  std::string text = std::string("duration = 12\nbuffer = 8\n") + kTwoSides + R"(
[[part]]
name = "floor"
chain = [[-900, 0], [900, 0]]
friction = 0.8
)";
  for (int post = 0; post < 4; ++post) {
    const float x = -14 + 3 * static_cast<float>(post);
    text += fmt::format(R"(
[[bricks]]
name = "post{0}"
brick = [0.25, 0.25]
position = [{1}, 0]
count = [3, 24]
density = 2
strength = 2
[[charges]]
name = "first{0}"
position = [{2}, 0.4]
radius = 3
impulse = {6}
speed = 12
at = {3}
[[charges]]
name = "second{0}"
position = [{4}, 0.9]
radius = 3
impulse = {6}
speed = 12
at = {5}
)",
                        post, x, x - 0.2, 1 + post, x + 0.9, 1.25 + post, impulse);
  }
  return text;
}

TEST(LostPiecesCluster, PostsThatAreBlownApartTwiceLieOnTheGround) {
  for (const int seed : SoakSeeds(1, 2)) {
    for (const double impulse : {6.0, 15.0, 40.0}) {
      ClusterConfig config;
      config.scene_text = Posts(impulse);
      config.impair = seed % 2 == 0 ? "4g" : "terrible";
      config.seed = seed;
      Cluster cluster(config);
      cluster.Run();
      EXPECT_GT(cluster.server().replica().world().body_count(), 40) << "not blown apart";
      const auto look = [&](const std::string& who, const World& world) {
        for (int body = 0; body < world.body_count(); ++body) {
          EXPECT_GT(world.Read(body).position.y(), 0) << "part " << world.id(body) << " at " << who
                                                      << ", " << impulse << " N s/m, seed " << seed;
        }
      };
      look("the server", cluster.server().replica().world());
      for (int c = 0; c < cluster.client_count(); ++c) {
        look("client " + std::to_string(c), cluster.client(c)->replica()->world());
      }
    }
  }
}

}  // namespace lost_pieces_test
}  // namespace seam
