/// Poses on LCM channels: at their rate, from ticks, of those parts that are there.

#include "common/sync/show/pose_publisher.h"

#include <gtest/gtest.h>

#include "common/codec/lcm_types.h"
#include "common/scene/scene.h"

namespace seam {
namespace pose_publisher_test {

struct Published : Recorder {
  void Publish(const std::string& channel, std::int64_t, ByteView message) override {
    LcmPose pose;
    EXPECT_TRUE(Decode(message, &pose).ok());
    poses[channel].push_back(pose);
  }
  std::map<std::string, std::vector<LcmPose>> poses;
};

constexpr const char* kScene = R"(
[[player]]
name = "ann"
[[part]]
name = "ball"
circle = 0.5
position = [1, 20]
velocity = [2, 0]
[[part]]
name = "wall"
box = [1, 1]
position = [9, 0]
angle = 0.5
anchored = true
[[lcm.publish]]
channel = "EACH"
parts = "ball"
[[lcm.publish]]
channel = "SLOW"
parts = ["ball", "wall"]
rate_hz = 7
[[lcm.publish]]
channel = "ANN"
parts = "ball"
player = "ann"
)";

TEST(PosePublisher, PublishesEachChannelAtItsRate) {
  World world(ParseScene(kScene, "s.toml"));
  Published published, by_ann;
  PosePublisher server(published, -1), ann(by_ann, 0);
  const auto read = [&](int body) { return world.Read(body); };
  for (int tick = 1; tick <= 600; ++tick) {
    world.Step();
    server.Publish(world, tick, 0, 5, read);
    if (tick % 3 == 0) ann.Publish(world, tick, 1, 5, read);  // it catches up three at once
  }
  EXPECT_TRUE(server.Publishes(world.scene()));
  EXPECT_FALSE(PosePublisher(published, 1).Publishes(world.scene()));
  const auto& each = published.poses["EACH"];
  const auto& slow = published.poses["SLOW"];
  ASSERT_EQ(each.size(), 600u);
  ASSERT_EQ(slow.size(), 2 * 70u);
  EXPECT_EQ(published.poses.size(), 2u);
  EXPECT_EQ(by_ann.poses["ANN"].size(), 200u) << "once for the ticks of a call";
  EXPECT_EQ(by_ann.poses["ANN"][0].tick, 3);
  EXPECT_EQ(by_ann.poses["ANN"][0].peer, 1);
  // Free fall from 20 m: after 60 ticks at (3, 15), the engine's sum a little below.
  EXPECT_EQ(each[59].tick, 60);
  EXPECT_NEAR(each[59].x, 3, 1e-4);
  EXPECT_NEAR(each[59].y, 15 - 10.0 / 120, 1e-3);
  EXPECT_NEAR(each[59].vy, -10, 1e-4);
  EXPECT_EQ(slow[1].name, "wall");
  EXPECT_EQ(slow[1].angle, 0.5);
  EXPECT_EQ(slow[1].vx, 0);
  for (std::size_t i = 2; i < slow.size(); i += 2) {
    EXPECT_NEAR(static_cast<double>(slow[i].tick - slow[i - 2].tick), 60.0 / 7, 1);
  }
}

TEST(PosePublisher, AClientThatGoesBackPublishesOn) {
  World world(ParseScene(kScene, "s.toml"));
  Published published;
  PosePublisher server(published, -1);
  const auto read = [&](int body) { return world.Read(body); };
  for (const int tick : {100, 101, 50, 51}) server.Publish(world, tick, 0, 5, read);
  EXPECT_EQ(published.poses["EACH"].size(), 4u);
  EXPECT_EQ(published.poses["SLOW"].size(), 0u) << "none of the four is due: 103 and 52 are";
}

}  // namespace pose_publisher_test
}  // namespace seam
