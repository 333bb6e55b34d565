/// Mechanisms that come to rest, and what wakes them.

#include <gtest/gtest.h>

#include "tests/physics/exact/exact_scenes.h"

namespace seam {
namespace {

/// A chain of `count` links that hangs from a post at height 8; it may sleep.
std::string Hanging(int count) {
  std::string text =
      PostText(0, 8) +
      PartText("link", "box = [0.2, 1]\nposition = [0, 7.5]\nangle = 0\nrepeat = {count = " +
                           std::to_string(count) + ", step = [0, -1]}");
  text += HingeText("top", "post", "link.0", 0, 8);
  for (int i = 0; i + 1 < count; ++i) {
    text += HingeText("h" + std::to_string(i), "link." + std::to_string(i),
                      "link." + std::to_string(i + 1), 0, 7 - i);
  }
  return text;
}

Scene Sleepy(const std::string& parts) {
  return ParseScene(std::string("[solver]\n") + kExactJoints + parts, "rest.toml");
}

bool AllAsleep(const World& world) {
  for (int body = 0; body < world.body_count(); ++body) {
    if (world.awake(body)) return false;
  }
  return true;
}

/// Ticks until nothing is awake; -1: not within `most`.
int TicksToSleep(World* world, int most) {
  for (int t = 0; t < most; ++t) {
    world->Step();
    if (AllAsleep(*world)) return t + 1;
  }
  return -1;
}

TEST(ExactRest, AHangingChainFallsAsleepAndKeepsItsPlace) {
  World world(Sleepy(Hanging(5)));
  const int ticks = TicksToSleep(&world, 120);
  EXPECT_GT(ticks, 25) << "not before the engine's half second";
  EXPECT_LT(ticks, 60);
  const std::vector<BodyState> before = StatesOf(world);
  Steps(&world, 300);
  EXPECT_TRUE(AllAsleep(world));
  for (int body = 0; body < 5; ++body) {
    EXPECT_EQ(world.Read(body).position, before[static_cast<std::size_t>(body)].position);
  }
}

TEST(ExactRest, APushOnOneLinkWakesTheWholeChainAndItSwings) {
  World world(Sleepy(Hanging(5)));
  ASSERT_GT(TicksToSleep(&world, 120), 0);
  BodyState last = world.Read(4);
  last.velocity = {3, 0};
  world.Write(4, last);
  Steps(&world, 2);
  for (int body = 0; body < 5; ++body) EXPECT_TRUE(world.awake(body)) << body;
  Steps(&world, 20);
  EXPECT_GT(world.Read(4).position.x(), 0.3);
  EXPECT_LT(Drift(world), 1e-5);
}

TEST(ExactRest, AFreeBodyThatHitsASleepingChainWakesIt) {
  World world(
      Sleepy(Hanging(5) + PartText("ball", "circle = 0.2\nposition = [-8, 4.9]\ndensity = 10")));
  const int ball = 5;
  BodyState away = world.Read(ball);
  for (int t = 0; t < 120 && !(world.awake(ball) && !world.awake(0)); ++t) {
    world.Write(ball, away);  // held where it is
    world.Step();
  }
  ASSERT_FALSE(world.awake(0));
  away.velocity = {14, 4};
  world.Write(ball, away);
  bool woke = false;
  for (int t = 0; t < 90; ++t) {
    world.Step();
    woke = woke || world.awake(0);
    EXPECT_LT(Drift(world), 1e-4);
  }
  EXPECT_TRUE(woke);
}

TEST(ExactRest, ALinkageOnTheGroundFallsAsleepWithWhatLiesOnIt) {
  World world(Sleepy(kGround +
                     PartText("plank",
                              "box = [2, 0.2]\nposition = [0, 0.115]\n"
                              "repeat = {count = 2, step = [2, 0]}") +
                     HingeText("h", "plank.0", "plank.1", 1, 0.115) +
                     PartText("crate", "box = [0.5, 0.5]\nposition = [0, 0.48]")));
  EXPECT_GT(TicksToSleep(&world, 300), 0);
}

TEST(ExactRest, ALoadOnASpringFallsAsleep) {
  World world(Sleepy(PostText(0, 0) + PartText("load", "box = [1, 1]\nposition = [0, -3]") +
                     "[[joint]]\nname = \"j\"\nkind = \"distance\"\na = \"post\"\nb = \"load\"\n"
                     "frequency = 2\ndamping_ratio = 1\n"));
  EXPECT_GT(TicksToSleep(&world, 900), 0);
}

TEST(ExactRest, AMotorsOrderWakesWhatSleeps) {
  World world(
      Sleepy("[[player]]\nname = \"ann\"\n" + PostText(0, 0) +
             PartText("arm", "box = [2, 0.1]\nposition = [1, 0]") +
             HingeText("axle", "post", "arm", 0, 0,
                       "motor = {player = \"ann\", axis = \"lift\", speed = 2, torque = 50}")));
  world.SetInput(0, Input{});
  ASSERT_GT(TicksToSleep(&world, 240), 0);
  Input lift;
  lift.lift = 127;
  world.SetInput(0, lift);
  Steps(&world, 60);
  EXPECT_NEAR(world.Read(0).angle, 2, 0.05);
}

}  // namespace
}  // namespace seam
