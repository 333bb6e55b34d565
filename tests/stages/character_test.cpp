/// Active characters: their abilities, each with bounded torque and without hidden forces.

#include <gtest/gtest.h>

#include "tests/support/character_world.h"

namespace seam {
namespace character_test {

/// m that the hero comes along in `seconds` of a script, or 0 if it falls.
float Way(const std::string& script, float seconds, const std::string& ground = kFlatGround,
          const std::string& at = "position = [0, 0]\n") {
  ScriptedWorld run(CharacterScene(at, script, ground));
  const float from = Look(run).centre.x();
  while (run.world.tick() < static_cast<int>(60 * seconds)) {
    run.Step();
    if (!Look(run).upright()) return 0;
  }
  return Look(run).centre.x() - from;
}

TEST(ActiveCharacter, StandsForTenSecondsWithoutComingAlong) {
  EXPECT_NEAR(Way("[[0, {}]]", 10), 0, 0.1);
}

TEST(ActiveCharacter, RecoversFromAPushAndFallsAtThreeTimesIt) {
  // 0.5 N s are 0.77 m/s of the whole body: more than its feet could stop without a step.
  for (const float side : {-1.0f, 1.0f}) {
    EXPECT_TRUE(StandsUnder(side * 0.5f)) << side;
    EXPECT_FALSE(StandsUnder(side * 1.5f)) << side;
  }
}

TEST(ActiveCharacter, RunsTenMetresForwardAndFiveBackward) {
  EXPECT_GT(Way("[[0.5, {drive = 1.0}]]", 7), 10);
  EXPECT_LT(Way("[[0.5, {drive = -0.6}]]", 11), -5);
}

TEST(ActiveCharacter, FacingLeftItRunsToTheLeft) {
  const float way =
      Way("[[0.5, {drive = -1.0}]]", 7, kFlatGround, "position = [0, 0]\nfacing = \"left\"\n");
  EXPECT_LT(way, -10);
}

TEST(ActiveCharacter, StopsWhenItsPlayerDoes) {
  ScriptedWorld run(CharacterScene("position = [0, 0]\n", "[[0.5, {drive = 0.8}], [4, {}]]"));
  run.StepTo(480);
  EXPECT_TRUE(Look(run).upright());
  EXPECT_LT(Look(run).velocity.norm(), 0.1);
}

TEST(ActiveCharacter, JumpsAndLandsOnItsFeet) {
  ScriptedWorld run(CharacterScene("position = [0, 0]\n", "[[1, {lift = 1.0}], [1.5, {}]]"));
  run.StepTo(60);
  const float from = Look(run).centre.y();
  float highest = from, soles = 0;
  while (run.world.tick() < 360) {
    run.Step();
    highest = std::max(highest, Look(run).centre.y());
    soles = std::max(soles, Look(run).foot_y - 0.045f);
    EXPECT_GT(Look(run).head_y, 1.0f);
  }
  EXPECT_GT(highest - from, 0.25f);
  EXPECT_GT(soles, 0.2f);
  EXPECT_TRUE(Look(run).upright());
}

TEST(ActiveCharacter, GetsUpFromBackAndFront) {
  for (const char* angle : {"1.5", "-1.5"}) {
    ScriptedWorld run(CharacterScene(std::string("position = [0, 0.2]\nangle = ") + angle + "\n"));
    run.StepTo(20);
    EXPECT_LT(Look(run).head_y, 0.5f) << "it lies";
    run.StepTo(60 * 8);
    EXPECT_TRUE(Look(run).upright()) << angle;
  }
}

TEST(ActiveCharacter, WalksUpAndDownASlopeOfSeventeenDegrees) {
  const std::string begin = "[[part]]\nname = \"ground\"\nfriction = 0.9\nchain = ";
  const char* drive = "[[0.5, {drive = 0.5}]]";
  EXPECT_GT(Way(drive, 9.5, begin + "[[-50, 0], [2, 0], [16.33, 4.433], [60, 4.433]]\n"), 8);
  EXPECT_GT(Way(drive, 9.5, begin + "[[-50, 4.433], [2, 4.433], [16.33, 0], [60, 0]]\n",
                "position = [0, 4.433]\n"),
            8);
}

TEST(ActiveCharacter, ClimbsStairs) {
  const std::string stairs = R"(
[[part]]
name = "ground"
chain = [[-50, 0], [2, 0], [2.02, 0.1], [2.5, 0.1], [2.52, 0.2], [3, 0.2], [3.02, 0.3], [3.5, 0.3],
         [3.52, 0.4], [4, 0.4], [4.02, 0.5], [60, 0.5]]
friction = 0.9
)";
  ScriptedWorld run(CharacterScene("position = [0, 0]\n", "[[0.5, {drive = 0.4}]]", stairs));
  for (int tick = 0; tick < 60 * 12; ++tick) {
    run.Step();
    ASSERT_TRUE(Look(run).upright()) << Look(run).centre;
  }
  EXPECT_GT(Look(run).centre.x(), 4.5f);
  EXPECT_NEAR(Look(run).centre.y(), 1.35f, 0.12f);
}

TEST(ActiveCharacter, RidesAMovingPlatform) {
  // A cart of 4 kg, whose motors roll it at 1 m/s.
  const std::string cart = std::string(kFlatGround) + R"(
[[part]]
name = "cart"
box = [4, 0.2]
position = [0, 0.6]
density = 5
velocity = [1, 0]
friction = 0.9
[[part]]
name = "wheel"
circle = 0.25
position = [-1.5, 0.25]
velocity = [1, 0]
spin = -4
repeat = {count = 2, step = [3, 0]}
[[joint]]
name = "axle"
kind = "revolute"
a = "cart"
b = "wheel.0"
anchor = [-1.5, 0.25]
motor = {speed = -4, torque = 20}
[[joint]]
name = "front"
kind = "revolute"
a = "cart"
b = "wheel.1"
anchor = [1.5, 0.25]
motor = {speed = -4, torque = 20}
)";
  ScriptedWorld run(CharacterScene("position = [0, 0.72]\nvelocity = [1, 0]\n", "[[0, {}]]", cart));
  for (int tick = 0; tick < 600; ++tick) {
    run.Step();
    ASSERT_TRUE(Look(run).upright()) << tick;
  }
  EXPECT_GT(run.Read("cart").position.x(), 8.0f);
  EXPECT_NEAR(Look(run).centre.x(), run.Read("cart").position.x(), 1.5f);
}

TEST(ActiveCharacter, ItsMotorsKeepTheirBounds) {
  ScriptedWorld run(CharacterScene(
      "position = [0, 0]\n", "[[0.5, {drive = 1.0}], [3, {drive = 1.0, lift = 1.0}], [5, {}]]"));
  const Scene& scene = run.world.scene();
  float share = 0;
  for (int tick = 0; tick < 420; ++tick) {
    run.Step();
    const std::vector<float> torques = MotorTorques(&run);
    for (std::size_t j = 0; j < torques.size(); ++j) {
      share = std::max(share, std::abs(torques[j]) / scene.joints[j].motor_torque);
    }
  }
  EXPECT_GT(share, 0.8f) << "the run shows little if nothing is near its bound";
  EXPECT_LT(share, 1.0001f);
}

TEST(ActiveCharacter, WithoutContactsItsCentreOfMassFliesAParabola) {
  ScriptedWorld run(CharacterScene("position = [0, 60]\nangle = 0.5\nvelocity = [3, 6]\n",
                                   "[[0, {drive = 1.0}], [1, {lift = 1.0}], [1.5, {}]]"));
  const Vec2 from = Look(run).centre;
  float worked = 0;
  for (int tick = 1; tick <= 120; ++tick) {
    run.Step();
    // The engine's steps are h = 1/240 s long: after n of them it fell g h^2 n (n + 1) / 2.
    const double t = tick / 60.0, fallen = 5 * t * (t + 1 / 240.0);
    EXPECT_NEAR(Look(run).centre.x(), from.x() + 3 * t, 2e-3);
    EXPECT_NEAR(Look(run).centre.y(), from.y() + 6 * t - fallen, 2e-3);
    for (const float torque : MotorTorques(&run)) worked = std::max(worked, std::abs(torque));
  }
  EXPECT_GT(worked, 0.05f) << "its motors were at work";
}

TEST(ActiveCharacter, ABarrierReplaysItBitForBit) {
  const Scene scene = CharacterScene(
      "position = [0, 0]\n", "[[0.5, {drive = 0.8}], [2, {drive = 0.8, lift = 1.0}], [3, {}]]");
  for (const int at : {20, 60, 110, 130, 170}) {
    ScriptedWorld run(scene);
    run.StepTo(at);
    const WorldSnapshot snapshot = run.world.Barrier();
    std::vector<std::uint64_t> first;
    for (int tick = 0; tick < 120; ++tick) {
      run.Step();
      first.push_back(run.world.Hash());
    }
    EXPECT_TRUE(run.world.Restore(snapshot).ok());
    for (int tick = 0; tick < 120; ++tick) {
      run.Step();
      ASSERT_EQ(run.world.Hash(), first[static_cast<std::size_t>(tick)]) << at << " + " << tick;
    }
  }
}

}  // namespace character_test
}  // namespace seam
