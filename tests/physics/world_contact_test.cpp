/// World: impacts against the formulas of mechanics, sleep, terrain, and collision filters.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scripted_world.h"

namespace seam {
namespace world_contact_test {

ScriptedWorld Simulate(const std::string& text) {
  return ScriptedWorld(ParseScene(text, "test.toml"));
}

const std::string kGround = R"(
[[part]]
name = "ground"
chain = [[-50, 0], [50, 0]]
)";

/// Steps until something is felt, at most a second; the strongest impact.
Impact FirstImpact(ScriptedWorld& run) {
  while (run.world.tick() < 60 && run.world.impacts().empty()) run.Step();
  Impact strongest;
  for (const Impact& i : run.world.impacts()) {
    if (i.dv > strongest.dv) strongest = i;
  }
  return strongest;
}

TEST(WorldContact, AnImpactIsTheImpulseOverTheLighterMass) {
  ScriptedWorld run = Simulate(R"(
gravity = [0, 0]
[[part]]
name = "one"
circle = 0.5
density = 3
friction = 0
restitution = 0.5
position = [-3, 0]
velocity = [6, 0]
[[part]]
name = "two"
circle = 0.5
restitution = 0.5
)");
  // J = (1 + e) v m1 m2 / (m1 + m2); the lighter feels J / m2. e is the larger of the two.
  const Impact impact = FirstImpact(run);
  EXPECT_EQ(impact.body_a, 0);
  EXPECT_EQ(impact.body_b, 1);
  EXPECT_NEAR(impact.dv, 1.5f * 6 * 3 / 4, 1e-4);
  EXPECT_NEAR(impact.point.x(), -0.5f, 0.2f) << "where they meet, within two steps of 0.1 m";
  EXPECT_NEAR(run.Read("two").velocity.x(), impact.dv, 1e-4);
}

TEST(WorldContact, AnImpactOnTheGroundCountsInFull) {
  ScriptedWorld run = Simulate(kGround + R"(
[[part]]
name = "ball"
circle = 0.5
position = [0, 1.5]
velocity = [0, -5]
)");
  const Impact impact = FirstImpact(run);
  EXPECT_EQ(impact.body_a, -1);
  EXPECT_EQ(impact.body_b, run.Body("ball"));
  // It fell for 0.17 s before it was stopped: 5 + 10 * 0.17, a tick's gravity more or less.
  const double fallen = 5 + 10.0 / 60 * static_cast<double>(run.world.tick());
  EXPECT_NEAR(impact.dv, fallen, 10.0 / 60 + 1e-3);
}

TEST(WorldContact, RestingWeightIsNoImpact) {
  ScriptedWorld run = Simulate(kGround + R"(
[[part]]
name = "box"
box = [1, 1]
position = [0, 0.515]
)");
  for (int i = 0; i < 120; ++i) {
    run.Step();
    EXPECT_TRUE(run.world.impacts().empty()) << run.world.tick();
  }
}

const std::string kSleeper = kGround + R"(
[[part]]
name = "box"
box = [1, 1]
position = [0, 0.515]
)";

TEST(WorldContact, AWriteWithoutWakingLeavesASleeperAsleepInItsNewPlace) {
  ScriptedWorld run = Simulate(kSleeper);
  const int box = run.Body("box");
  run.StepTo(120);
  ASSERT_FALSE(run.world.awake(box));
  run.world.Write(box, BodyState{{3, 5}, 0.5f, {1, 1}, 2}, false);
  EXPECT_FALSE(run.world.awake(box));
  run.StepTo(180);
  const BodyState s = run.world.Read(box);
  EXPECT_EQ(s.position, Vec2(3, 5)) << "it sleeps in the air";
  EXPECT_EQ(s.angle, 0.5f);
  EXPECT_EQ(s.velocity, Vec2(0, 0));
  EXPECT_EQ(s.spin, 0);
  run.world.Write(box, s);
  EXPECT_TRUE(run.world.awake(box));
  run.StepTo(240);
  EXPECT_LT(run.world.Read(box).position.y(), 4);
}

TEST(WorldContact, SleepCanBeSwitchedOff) {
  ScriptedWorld run = Simulate("[solver]\nsleep = false\n" + kSleeper);
  run.StepTo(300);
  EXPECT_TRUE(run.world.awake(0));
}

TEST(WorldContact, WritingBackAReadStateChangesNothing) {
  ScriptedWorld run("stack"), written("stack");
  for (int i = 0; i < 300; ++i) {
    for (int body = 0; body < written.world.body_count(); ++body) {
      written.world.Write(body, written.world.Read(body), written.world.awake(body));
    }
    run.Step();
    written.Step();
    ASSERT_EQ(run.world.Hash(), written.world.Hash()) << run.world.tick();
  }
}

const std::string kValley = R"(
[[part]]
name = "valley"
chain = [[-10, 3], [-5, 1], [0, 0], [5, 1], [10, 3]]
position = [100, 20]
[[part]]
name = "ball"
circle = 0.5
)";

TEST(WorldContact, ABallRestsOnGroundThatIsListedFromLeftToRight) {
  ScriptedWorld run = Simulate(kValley + "position = [100, 22]\n");
  run.StepTo(600);
  const BodyState ball = run.Read("ball");
  // Slopes of 1 in 5 meet at (100, 20): 0.5 m from both, give or take skin and slop.
  EXPECT_NEAR(ball.position.x(), 100, 0.01);
  EXPECT_NEAR(ball.position.y(), 20 + 0.5 * std::sqrt(1.04), 0.02);
  EXPECT_NEAR(ball.velocity.norm(), 0, 1e-2);
}

TEST(WorldContact, TerrainIsOpenFromBelow) {
  ScriptedWorld run = Simulate(kValley + "position = [100, 19]\nvelocity = [0, 20]\n");
  run.StepTo(30);
  EXPECT_GT(run.Read("ball").position.y(), 25);
}

TEST(WorldContact, BulletsDoNotTunnelThroughThinMovingBodies) {
  const auto shot = [](const char* bullet) {
    ScriptedWorld run = Simulate(std::string(R"(
gravity = [0, 0]
[[part]]
name = "plate"
box = [0.1, 4]
density = 10
[[part]]
name = "ball"
circle = 0.1
position = [-10.8, 0]
velocity = [100, 0]
bullet = )") + bullet);
    run.StepTo(30);
    return run.Read("ball").position.x() > run.Read("plate").position.x();
  };
  EXPECT_TRUE(shot("false")) << "it steps from -0.8 m to 0.87 m";
  EXPECT_FALSE(shot("true"));
}

TEST(WorldContact, PartsOfOneNegativeGroupPassThroughEachOther) {
  const auto meet = [](const char* group) {
    ScriptedWorld run = Simulate(std::string(R"(
gravity = [0, 0]
[[part]]
name = "one"
circle = 0.5
position = [-3, 0]
velocity = [6, 0]
group = -1
[[part]]
name = "two"
circle = 0.5
group = )") + group);
    run.StepTo(120);
    return run.Read("two").velocity.x() > 0;
  };
  EXPECT_TRUE(meet("-2"));
  EXPECT_FALSE(meet("-1"));
}

TEST(WorldContact, ASpringSwingsAtItsFrequency) {
  // 1 Hz without damping, stretched by half a metre: back through rest after a quarter, ...
  ScriptedWorld run = Simulate(R"(
gravity = [0, 0]
[solver]
tick_hz = 240
[[part]]
name = "post"
box = [0.2, 0.2]
anchored = true
[[part]]
name = "mass"
circle = 0.5
position = [3.5, 0]
[[joint]]
name = "spring"
kind = "distance"
a = "post"
b = "mass"
length = 3
frequency = 1
damping_ratio = 0
)");
  run.StepTo(120);
  EXPECT_NEAR(run.Read("mass").position.x(), 2.5, 0.03) << "half a period: the other side";
  run.StepTo(240);
  EXPECT_NEAR(run.Read("mass").position.x(), 3.5, 0.06) << "a soft constraint damps by h";
}

}  // namespace world_contact_test
}  // namespace seam
