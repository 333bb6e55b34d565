/// The contract of World: motion, inputs, contacts, sleep, one body for welded parts.

#include "common/physics/world.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/geometry.h"
#include "tests/support/scripted_world.h"

namespace seam {
namespace world_test {

ScriptedWorld Simulate(const std::string& text) {
  return ScriptedWorld(ParseScene(text, "test.toml"));
}

const std::string kGround = R"(
[[part]]
name = "ground"
chain = [[-50, 0], [50, 0]]
)";
const std::string kBox = R"(
[[part]]
name = "box"
box = [1, 1]
position = [0, 0.515]
)";

TEST(World, KinematicBodiesMoveByTheirVelocityDespiteCollisions) {
  ScriptedWorld run = Simulate(kGround + kBox + R"(
[[part]]
name = "ball"
circle = 0.4
density = 20
position = [0.5, 2.5]
)");
  const int box = run.Body("box"), ball = run.Body("ball");
  run.world.SetActivity(box, Activity::kKinematic);
  EXPECT_EQ(run.world.activity(box), Activity::kKinematic);
  run.world.Write(box, BodyState{{0, 3}, 0, {2, 0.5f}, 1});
  run.world.Write(ball, BodyState{{0.2f, 4.5f}, 0, {2, -3}, 0});
  run.StepTo(60);
  const BodyState s = run.world.Read(box);
  EXPECT_EQ(s.velocity, Vec2(2, 0.5f));
  EXPECT_EQ(s.spin, 1);
  // Sixty additions in single precision.
  EXPECT_NEAR(s.position.x(), 2, 1e-5);
  EXPECT_NEAR(s.position.y(), 3.5, 1e-5);
  EXPECT_NEAR(s.angle, 1, 1e-5);
  EXPECT_GT(run.world.Read(ball).position.y(), 2) << "the ball falls on it and feels it";
}

/// An assembly whose centre of mass is not its root's: two boxes of 3 and 1 kg, 2 m apart.
const std::string kDumbbell = R"(
gravity = [0, 0]
[[part]]
name = "heavy"
box = [1, 1]
density = 3
position = [10, 5]
[[part]]
name = "light"
box = [1, 1]
position = [12, 5]
[[joint]]
name = "bar"
kind = "weld"
a = "light"
b = "heavy"
)";

TEST(World, WeldedPartsAreOneBodyThatTurnsAboutTheirCentreOfMass) {
  ScriptedWorld run = Simulate(kDumbbell);
  ASSERT_EQ(run.world.body_count(), 1);
  EXPECT_EQ(run.world.id(0), 0) << "the heavier part is the root";
  EXPECT_EQ(run.Body("light"), 0);
  EXPECT_FLOAT_EQ(run.world.mass(0), 4);
  // The centre of mass lies 0.5 m right of the root.
  BodyState start = run.world.Read(0);
  EXPECT_EQ(start.position, Vec2(10, 5));
  start.spin = 1;
  run.world.Write(0, start);
  run.StepTo(60);
  const BodyState s = run.world.Read(0);
  EXPECT_NEAR(s.angle, 1, 1e-5);
  EXPECT_NEAR(s.position.x(), 10.5 - 0.5 * std::cos(1.0), 1e-5);
  EXPECT_NEAR(s.position.y(), 5 - 0.5 * std::sin(1.0), 1e-5);
  // Its energy: two squares of m a^2 / 6 each, and their distances of 0.5 and 1.5 m.
  const double inertia = 3.0 / 6 + 1.0 / 6 + 3 * 0.25 + 1 * 2.25;
  EXPECT_NEAR(run.world.Energy(), inertia / 2, 1e-5);
}

TEST(World, AChangeOfMotionCarriesTheVelocityOver) {
  ScriptedWorld run = Simulate(kDumbbell);
  run.world.Write(0, BodyState{{10, 5}, 0, {1, 0}, 2});
  run.world.SetActivity(0, Activity::kKinematic);
  // The root lies 0.5 m left of the centre and turns about it with 2 rad/s.
  EXPECT_NEAR(run.world.Read(0).velocity.x(), 1, 1e-6);
  EXPECT_NEAR(run.world.Read(0).velocity.y(), -1, 1e-6);
  run.world.SetActivity(0, Activity::kSimulated);
  EXPECT_EQ(run.world.activity(0), Activity::kSimulated);
  EXPECT_NEAR(run.world.Read(0).velocity.x(), 1, 1e-6);
  EXPECT_NEAR(run.world.Read(0).velocity.y(), 0, 1e-6);
  EXPECT_EQ(run.world.Read(0).spin, 2);
  EXPECT_FLOAT_EQ(run.world.mass(0), 4);
}

TEST(World, ActionsPushTheWholeAssemblyAtItsCentre) {
  ScriptedWorld run = Simulate(kDumbbell + R"(
[[player]]
name = "ann"
actions = [{button = 3, part = "light", impulse = [8, 4]}]
script = [[0.1, {buttons = [3]}], [0.5, {}], [0.6, {buttons = [3]}]]
)");
  run.StepTo(5);
  EXPECT_EQ(run.world.Read(0).velocity, Vec2(0, 0));
  run.StepTo(30);
  EXPECT_EQ(run.world.Read(0).velocity, Vec2(2, 1)) << "once, while the button is held";
  EXPECT_EQ(run.world.Read(0).spin, 0);
  run.StepTo(40);
  EXPECT_EQ(run.world.Read(0).velocity, Vec2(4, 2));
}

/// Two wheels on an anchored frame: one follows ann's drive, one turns by itself.
const std::string kWheels = R"(
gravity = [0, 0]
[[part]]
name = "frame"
box = [4, 0.2]
anchored = true
[[part]]
name = "hers"
circle = 0.5
position = [-1, -1]
[[part]]
name = "fan"
circle = 0.5
position = [1, -1]
[[player]]
name = "ann"
[[player]]
name = "bob"
[[joint]]
name = "axle"
kind = "wheel"
a = "frame"
b = "hers"
frequency = 5
motor = {player = "ann", speed = -20, torque = 5}
[[joint]]
name = "axle2"
kind = "revolute"
a = "frame"
b = "fan"
motor = {speed = 3, torque = 5}
)";

TEST(World, MotorsFollowTheirPlayersDrive) {
  ScriptedWorld run = Simulate(kWheels);
  const auto spin_after = [&](int player, std::int8_t drive) {
    run.world.SetInput(player, Input{drive, 0, 0});
    for (int i = 0; i < 60; ++i) run.world.Step();
    return run.Read("hers").spin;
  };
  EXPECT_NEAR(spin_after(1, 127), 0, 1e-4) << "bob's drive is not ann's";
  EXPECT_NEAR(spin_after(0, 127), -20, 1e-3);
  EXPECT_NEAR(spin_after(0, -127), 20, 1e-3);
  EXPECT_NEAR(spin_after(0, -128), 20, 1e-3) << "beyond the scale is full drive";
  EXPECT_NEAR(spin_after(0, 64), -20.0f * 64 / 127, 1e-3);
  EXPECT_NEAR(spin_after(0, 0), 0, 1e-3) << "a motor at rest brakes";
  EXPECT_NEAR(run.Read("fan").spin, 3, 1e-3) << "without a player it turns constantly";
}

TEST(World, AMotorIsNoStrongerThanItsTorque) {
  ScriptedWorld run = Simulate(kWheels);
  run.world.SetInput(0, Input{127, 0, 0});
  run.world.Step();
  // torque / inertia / 60, inertia = pi r^4 / 2.
  const float inertia = kPiFloat * 0.0625f / 2;
  EXPECT_NEAR(run.Read("hers").spin, -5 / inertia / 60, 1e-3);
}

TEST(World, TouchesAreThePairsOfMovingBodiesEachOnce) {
  ScriptedWorld run = Simulate(kGround + R"(
[[part]]
name = "box"
box = [1, 1]
position = [0, 0.515]
repeat = {count = 3, step = [0, 1.015]}
[[part]]
name = "far"
circle = 0.5
position = [5, 0.5]
)");
  run.StepTo(5);
  const std::vector<Touch>& touches = run.world.touches();
  ASSERT_EQ(touches.size(), 2u);
  EXPECT_EQ(touches[0].body_a, 0);
  EXPECT_EQ(touches[0].body_b, 1);
  EXPECT_EQ(touches[1].body_a, 1);
  EXPECT_EQ(touches[1].body_b, 2);
}

TEST(World, BlocksAreContactsWithAnchoredBodies) {
  ScriptedWorld run = Simulate(kGround + kBox + R"(
[[part]]
name = "wall"
box = [1, 4]
position = [1.01, 2]
anchored = true
[[part]]
name = "bob"
circle = 0.3
position = [-5, 2]
[[part]]
name = "flying"
circle = 0.3
position = [-10, 8]
[[part]]
name = "hook"
box = [0.1, 0.1]
position = [-8, 6]
anchored = true
[[joint]]
name = "string"
kind = "distance"
a = "hook"
b = "bob"
)");
  run.world.Write(run.Body("box"), BodyState{{0, 0.51f}, 0, {1, 0}, 0});
  run.StepTo(2);
  const std::vector<BlockedDirection>& blocked_directions = run.world.blocked_directions();
  ASSERT_EQ(blocked_directions.size(), 3u)
      << "box: ground and wall; bob: its string; flying: nothing";
  EXPECT_EQ(blocked_directions[0].body, run.Body("box"));
  EXPECT_EQ(blocked_directions[1].body, run.Body("box"));
  const float across = std::max(std::abs(blocked_directions[0].normal.x()),
                                std::abs(blocked_directions[1].normal.x()));
  const float up = std::max(std::abs(blocked_directions[0].normal.y()),
                            std::abs(blocked_directions[1].normal.y()));
  EXPECT_NEAR(across, 1, 1e-3);
  EXPECT_NEAR(up, 1, 1e-3);
  EXPECT_EQ(blocked_directions[2].body, run.Body("bob"));
  const Vec2 along = (run.Read("bob").position - Vec2(-8, 6)).normalized();
  EXPECT_NEAR(std::abs(blocked_directions[2].normal.dot(along)), 1, 1e-4);
}

}  // namespace world_test
}  // namespace seam
