/// A holder's process dies. Its bodies keep moving in every view, long before its lease ends.

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "client/embed/cluster.h"

namespace seam {
namespace vanish_test {

/// Ann's disc goes by at 5 m/s; bob only looks, and the server has nothing there.
const char* const kPassing = R"(
gravity = [0, 0]
duration = 20
buffer = 2
follow = 0
server_follow = 0
[[player]]
name = "ann"
vehicle = "disc"
[[player]]
name = "bob"
region = [[400, -100], [900, 100]]
[[part]]
name = "disc"
circle = 0.5
velocity = [5, 0]
owner = "ann"
)";

/// Bob only looks: two messages of ann's disc that were lost in a row, before or after she was
/// gone, let it stand for him (seeds 7, 18 and 1 over 4g, most over terrible).
TEST(Vanish, TheHoldersBodiesKeepMovingInEveryView) {
  for (const char* reconcile : {"rollback", "retrospect", "fade"}) {
    for (const auto& [impair, seed] :
         {std::pair("demo", 1), std::pair("4g", 1), std::pair("4g", 7), std::pair("4g", 18),
          std::pair("terrible", 2), std::pair("terrible", 4), std::pair("terrible", 6)}) {
      SCOPED_TRACE(std::string(reconcile) + " " + impair + ", seed " + std::to_string(seed));
      ClusterConfig config;
      config.scene = "passing";
      config.scene_text = kPassing;
      config.reconcile = reconcile;
      config.impair = impair;
      config.seed = seed;
      config.drive = Drive::kNone;
      Cluster cluster(config);
      cluster.RunToTick(180);
      const AuthorityTable& table = cluster.server().replica().authority();
      ASSERT_EQ(table.at(0).authority, cluster.client(0)->peer());
      ASSERT_FALSE(table.at(0).secondaries.Has(0)) << "the server does not simulate it";
      const int bob = cluster.client(1)->peer();
      cluster.Kill(0);
      cluster.RunToTick(180 + 7 * 60);
      EXPECT_EQ(table.at(0).authority, 0) << "its lease is over";
      for (const int peer : {0, bob}) {
        const std::map<std::int64_t, View>& views = cluster.recording().views.at(peer);
        for (std::int64_t tick = 180; tick < 180 + 6 * 60; ++tick) {
          ASSERT_EQ(views.count(tick) + views.count(tick + 18), 2u) << tick;
          const float way = views.at(tick + 18).x[0] - views.at(tick).x[0];
          EXPECT_NEAR(way, 5 * 0.3f, 0.1f) << "in 0.3 s from tick " << tick << ", peer " << peer;
        }
      }
    }
  }
}

/// Ann's disc is pushed for as long as she drives, by her drive or by a button; bob only looks.
const char* const kPushed = R"(
gravity = [0, 0]
duration = 20
buffer = 2
follow = 0
server_follow = 0
[[player]]
name = "ann"
vehicle = "disc"
script = [[0, {drive = 1, buttons = [1]}]]
[[player]]
name = "bob"
region = [[400, -100], [900, 100]]
[[part]]
name = "disc"
circle = 0.5
owner = "ann"
[[thrust]]
name = "engine"
part = "disc"
force = [1, 0]
player = "ann"
)";

ClusterConfig Pushed(const char* mode, const char* impair, bool by_button) {
  ClusterConfig config;
  config.scene = "pushed";
  config.scene_text = std::string(kPushed) + (by_button ? "button = 1\n" : "");
  config.mode = mode;
  if (config.mode == "buffer") config.reconcile = "rollback";
  config.impair = impair;
  return config;
}

/// m/s in a peer's view, over 0.1 s.
float SpeedSeen(Cluster& cluster, int peer, std::int64_t tick) {
  const std::map<std::int64_t, View>& views = cluster.recording().views.at(peer);
  return (views.at(tick + 6).x[0] - views.at(tick).x[0]) / 0.1f;
}

TEST(Vanish, AKilledPlayersVehicleIsDrivenForLittleMoreThanASecond) {
  for (const char* mode : {"buffer", "central"}) {
    for (const bool by_button : {false, true}) {
      SCOPED_TRACE(std::string(mode) + (by_button ? ", button" : ", drive"));
      Cluster cluster(Pushed(mode, "4g", by_button));
      cluster.RunToTick(180);
      const int bob = cluster.client(1)->peer();
      cluster.Kill(0);
      cluster.RunToTick(180 + 4 * 60);
      for (const int peer : {0, bob}) {
        const float soon = SpeedSeen(cluster, peer, 180 + 150);
        EXPECT_GT(soon, SpeedSeen(cluster, 0, 180) + 0.5f) << "driven on at first, " << peer;
        EXPECT_NEAR(SpeedSeen(cluster, peer, 180 + 220), soon, 0.1f) << "let go, " << peer;
      }
    }
  }
}

TEST(Vanish, APlayerThatReturnsDrivesOnFromThere) {
  for (const char* mode : {"buffer", "central"}) {
    SCOPED_TRACE(mode);
    Cluster cluster(Pushed(mode, "4g", false));
    cluster.RunToTick(180);
    cluster.Pause(0, true);
    cluster.RunToTick(180 + 120);
    const InputTrack& inputs = cluster.server().replica().inputs(0);
    EXPECT_EQ(inputs.At(inputs.newest()).drive, 0);
    cluster.Pause(0, false);
    cluster.RunToTick(180 + 300);
    const std::int64_t now = cluster.server().replica().tick();
    EXPECT_EQ(inputs.At(now).drive, 127);
    // Bob's view still glides.
    for (const int peer : {0, cluster.client(0)->peer()}) {
      EXPECT_GT(SpeedSeen(cluster, peer, now - 18), SpeedSeen(cluster, peer, now - 78) + 0.5f);
    }
  }
}

/// Bad paths are no reason: 300 ms with 30 % loss each way, and the worst profile there is.
TEST(Vanish, APlayerThatOnlyLagsDrivesOn) {
  for (const char* mode : {"buffer", "central"}) {
    for (const char* impair : {"delay=300ms,loss=30%", "terrible"}) {
      for (std::int64_t seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(std::string(mode) + " " + impair + ", seed " + std::to_string(seed));
        ClusterConfig config = Pushed(mode, impair, seed % 2 == 0);
        config.seed = seed;
        Cluster cluster(config);
        const InputTrack& inputs = cluster.server().replica().inputs(0);
        cluster.RunToTick(120);
        ASSERT_EQ(inputs.At(inputs.newest()).drive, 127);
        for (std::int64_t tick = 121; tick <= 1080; ++tick) {
          cluster.RunToTick(tick);
          ASSERT_EQ(inputs.At(inputs.newest()).drive, 127) << tick;
        }
      }
    }
  }
}

}  // namespace vanish_test
}  // namespace seam
