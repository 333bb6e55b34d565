/// Limp characters and their recovery, and severed limbs.

#include <gtest/gtest.h>

#include "tests/support/character_world.h"

namespace seam {
namespace limp_test {

/// N m; the most that a motor turned with in the last of the engine's steps.
float Most(ScriptedWorld* run) {
  float most = 0;
  for (const float torque : MotorTorques(run)) most = std::max(most, std::abs(torque));
  return most;
}

TEST(Limp, FullLiftDownMakesItLimpAndReleasingItBringsItUp) {
  ScriptedWorld run(CharacterScene("position = [0, 0]\n", "[[1, {lift = -1.0}], [3, {}]]"));
  run.StepTo(59);
  EXPECT_TRUE(Look(run).upright());
  EXPECT_GT(Most(&run), 0.1f);
  run.StepTo(70);
  EXPECT_LT(Most(&run), 0.08f) << "muscle tone alone: 3 % of 2.33 N m";
  run.StepTo(179);
  EXPECT_LT(Look(run).head_y, 0.6f);
  run.StepTo(60 * 14);
  EXPECT_TRUE(Look(run).upright());
}

TEST(Limp, AHardPushMakesItLimpForAMomentAndALightOneDoesNot) {
  for (const float speed : {1.0f, 4.0f}) {
    ScriptedWorld run(CharacterScene("position = [0, 0]\n"));
    run.StepTo(60);
    const PartId torso = run.world.scene().characters[0].parts[kTorso];
    const Vec2 impulse(speed * Look(run).mass, 0);
    run.world.Apply({Edit(PushEdit{torso, impulse}, EditCause::kOutside)});
    run.StepTo(66);
    EXPECT_EQ(Most(&run) < 0.08f, speed > 2) << speed;
    run.StepTo(66 + 60);
    EXPECT_GT(Most(&run), 0.03f) << speed;
  }
}

/// Makes it limp by a script's command.
void GoLimp(ScriptedWorld* run, float seconds) {
  const PartId torso = run->world.scene().characters[0].parts[kTorso];
  run->world.Apply({Edit(PushEdit{torso, Vec2(0, 0), 0, seconds}, EditCause::kOutside)});
}

TEST(Limp, ACommandMakesItLimpForItsSecondsOrUntilAnotherEndsIt) {
  ScriptedWorld run(CharacterScene("position = [0, 0]\n"));
  run.StepTo(60);
  GoLimp(&run, 2);
  run.StepTo(60 + 115);
  EXPECT_LT(Most(&run), 0.08f) << "still limp after 1.9 s";
  run.StepTo(60 + 125);
  EXPECT_GT(Most(&run), 0.08f) << "no longer after 2.1 s";
  run.StepTo(60 * 12);
  ASSERT_TRUE(Look(run).upright());
  GoLimp(&run, kLimpUntilReleased);
  GoLimp(&run, 1);  // the longer one counts
  run.StepTo(60 * 40);
  EXPECT_LT(Most(&run), 0.08f);
  EXPECT_LT(Look(run).head_y, 0.6f) << "it stood still: tone alone must not hold it up";
  GoLimp(&run, -1);
  run.StepTo(60 * 55);
  EXPECT_TRUE(Look(run).upright());
}

TEST(Limp, ABarrierReplaysACommandBitForBit) {
  ScriptedWorld run(CharacterScene("position = [0, 0]\n"));
  run.StepTo(60);
  GoLimp(&run, 0.7f);
  run.StepTo(80);
  const WorldSnapshot snapshot = run.world.Barrier();
  std::vector<std::uint64_t> first;
  for (int tick = 0; tick < 120; ++tick) {
    run.Step();
    first.push_back(run.world.Hash());
  }
  ASSERT_TRUE(run.world.Restore(snapshot).ok());
  for (int tick = 0; tick < 120; ++tick) {
    run.Step();
    ASSERT_EQ(run.world.Hash(), first[static_cast<std::size_t>(tick)]) << tick;
  }
}

TEST(Limp, ABarrierReplaysItBitForBit) {
  ScriptedWorld run(CharacterScene("position = [0, 0]\n"));
  run.StepTo(60);
  const PartId torso = run.world.scene().characters[0].parts[kTorso];
  run.world.Apply({Edit(PushEdit{torso, {3, 1}}, EditCause::kOutside)});
  run.StepTo(70);
  const WorldSnapshot snapshot = run.world.Barrier();
  std::vector<std::uint64_t> first;
  for (int tick = 0; tick < 180; ++tick) {
    run.Step();
    first.push_back(run.world.Hash());
  }
  ASSERT_TRUE(run.world.Restore(snapshot).ok());
  for (const std::uint64_t hash : first) {
    run.Step();
    ASSERT_EQ(run.world.Hash(), hash);
  }
}

/// True if it stands 8 s after one of its joints was severed.
bool StandsWithout(CharacterJoint joint) {
  ScriptedWorld run(CharacterScene("position = [0, 0]\n"));
  run.StepTo(60);
  run.world.Apply({Edit(BreakEdit{run.world.scene().characters[0].joints[joint]})});
  run.StepTo(60 * 9);
  return std::abs(Look(run).lean) < 0.6f && run.Read("hero.torso").position.y() > 1;
}

TEST(SeveredLimbs, StandsWithoutAnArmOrAForearmAndFallsWithoutALeg) {
  EXPECT_TRUE(StandsWithout(kShoulderLeft));
  EXPECT_TRUE(StandsWithout(kElbowRight));
  EXPECT_FALSE(StandsWithout(kHipLeft));
  EXPECT_FALSE(StandsWithout(kKneeRight));
}

TEST(SeveredLimbs, ACharacterWithOneArmRunsOnAndLosingEveryLimbIsSafe) {
  ScriptedWorld run(CharacterScene("position = [0, 0]\n", "[[0.5, {drive = 0.6}]]"));
  run.StepTo(60);
  const auto joints = run.world.scene().characters[0].joints;
  run.world.Apply({Edit(BreakEdit{joints[kShoulderLeft]})});
  const float from = run.Read("hero.torso").position.x();
  run.StepTo(360);
  EXPECT_GT(run.Read("hero.torso").position.x(), from + 4);
  for (const int joint : joints) {
    run.world.Apply({Edit(BreakEdit{joint})});
    for (int tick = 0; tick < 20; ++tick) run.Step();
  }
  for (const PartId part : run.world.scene().characters[0].parts) {
    const std::string& name = run.world.scene().parts[static_cast<std::size_t>(part)].name;
    EXPECT_LT(run.Read(name).position.norm(), 100) << name;
  }
}

}  // namespace limp_test
}  // namespace seam
