/// Mechanisms that come to rest, and the events that wake them.

#include <gtest/gtest.h>

#include "tests/physics/exact/exact_scenes.h"

namespace seam {
namespace exact_rest_test {

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

TEST(ExactRest, ALinkageOnTheGroundFallsAsleepWithItsLoad) {
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

TEST(ExactRest, AMotorsInputWakesItsMechanism) {
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

/// A car on sprung wheels that drives at twelve crates, which sleep by then. `speed`: m/s.
std::string CarAtCrates(double speed) {
  const std::string moves = "velocity = [" + FloatDigits(speed) + ", 0]\n";
  const std::string spins = "spin = " + FloatDigits(-speed / 0.4) + "\n";
  std::string text = std::string(kGround) + "friction = 0.9\n" +
                     PartText("car",
                              "polygon = [[-1.6, -0.5], [1.45, -0.6], [1.6, -0.55], [1.6, 0.1], "
                              "[0.5, 0.45], [-1.2, 0.45], [-1.6, 0.2]]\nposition = [-20, 0.9]\n"
                              "density = 2\nfriction = 0.1\nbullet = true\n" +
                                  moves) +
                     PartText("wheel",
                              "circle = 0.4\nposition = [-21, 0.41]\nfriction = 0.9\n"
                              "repeat = {count = 2, step = [2, 0]}\n" +
                                  moves + spins) +
                     PartText("crate",
                              "box = [0.9, 0.9]\nposition = [12, 0.46]\ndensity = 0.5\n"
                              "friction = 0.4\nrepeat = {count = [4, 3], step = [1.2, 0.915]}\n");
  for (const char* wheel : {"0", "1"}) {
    text += "[[joint]]\nname = \"axle" + std::string(wheel) +
            "\"\nkind = \"wheel\"\na = \"car\"\nb = \"wheel." + wheel + "\"\nfrequency = 5\n";
  }
  return text;
}

/// Continuous collision moves a body back to its impact and closes its mechanism there, with
/// everything in contact. A body agreed to be at rest would be put back (RestCommit) if it still
/// slept, and a replay would not do that.
TEST(ExactRest, ClosingAMechanismDoesNotMoveSleepers) {
  int moved = 0, struck = 0;
  for (int n = 0; n < 24; ++n) {
    World world(Sleepy(CarAtCrates(12 + 0.25 * n)));
    for (int t = 0; t < 300; ++t) {
      const std::vector<BodyState> before = StatesOf(world);
      std::vector<bool> slept;
      for (int body = 0; body < world.body_count(); ++body) slept.push_back(!world.awake(body));
      world.Step();
      for (int body = 0; body < world.body_count(); ++body) {
        const auto b = static_cast<std::size_t>(body);
        struck += slept[b] && world.awake(body);
        if (!slept[b] || world.awake(body)) continue;
        const BodyState now = world.Read(body);
        moved += now.position != before[b].position || now.angle != before[b].angle;
      }
    }
  }
  EXPECT_GT(struck, 24);
  EXPECT_EQ(moved, 0);
}

}  // namespace exact_rest_test
}  // namespace seam
