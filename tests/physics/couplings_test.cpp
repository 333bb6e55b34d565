/// Gears and pulleys against their equations.

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/geometry.h"
#include "common/measure/joint_drift.h"
#include "tests/support/small_world.h"

namespace seam {
namespace couplings_test {

const std::string kPost =
    "[[part]]\nname = \"post\"\nbox = [0.2, 0.2]\nposition = [0, 5]\nanchored = true\n";
const char* kWeightless = "gravity = [0, 0]\n";

std::string Named(const std::string& name, const std::string& rest) {
  return "[[part]]\nname = \"" + name + "\"\n" + rest + "\n";
}

std::string Joined(const std::string& name, const std::string& kind, const std::string& rest) {
  return "[[joint]]\nname = \"" + name + "\"\nkind = \"" + kind + "\"\n" + rest + "\n";
}

/// Discs of 1 m and 2 m side by side, their moments pi/2 and 8 pi; the first is turned by a motor.
std::string Gearbox(const std::string& motor) {
  return kPost + Named("small", "circle = 1\nposition = [0, 0]") +
         Named("large", "circle = 2\nposition = [3, 0]") +
         Joined("first", "hinge", "a = \"post\"\nb = \"small\"\n" + motor) +
         Joined("second", "hinge", "a = \"post\"\nb = \"large\"") +
         Joined("gear", "gear", "joints = [\"first\", \"second\"]\nratio = 2");
}

double DriftOf(const World& world) {
  std::vector<BodyState> states;
  for (int body = 0; body < world.body_count(); ++body) states.push_back(world.Read(body));
  return JointMeter(world.scene(), world.composition()).Worst(states, world.tick());
}

double AngleOf(const World& world, int body) { return double{world.Read(body).angle}; }

TEST(Couplings, AGearTurnsTheOtherWheelByTheRatioAndTakesItsMoment) {
  const auto world = SmallWorld(Gearbox("motor = {speed = 1000, torque = 6}"), "", kWeightless);
  Steps(world.get(), 120);
  // w1 = -2 w2, so T = (I1 + I2 / 4) alpha1.
  EXPECT_NEAR(double{world->Read(0).spin}, 2 * 6 / (kPi / 2 + 8 * kPi / 4), 2e-3);
  EXPECT_NEAR(double{world->Read(1).spin}, -double{world->Read(0).spin} / 2, 1e-4);
  EXPECT_GT(AngleOf(*world, 0), 1);
  EXPECT_NEAR(AngleOf(*world, 0) + 2 * AngleOf(*world, 1), 0, 1e-4);
  EXPECT_LT(DriftOf(*world), 1e-4);
}

TEST(Couplings, ARackTurnsItsPinion) {
  // 2 kg fall, a disc of 0.5 m turns: x + r q = 0, a = m g / (m + I / r^2).
  const auto world =
      SmallWorld(kPost + Named("rack", "box = [1, 2]\nposition = [5, 0]\ndensity = 1") +
                 Named("pinion", "circle = 0.5\nposition = [0, 0]\ndensity = 4") +
                 Joined("slide", "prismatic", "a = \"post\"\nb = \"rack\"\naxis = [0, 1]") +
                 Joined("axle", "hinge", "a = \"post\"\nb = \"pinion\"") +
                 Joined("gear", "gear", "joints = [\"slide\", \"axle\"]\nratio = 0.5"));
  Steps(world.get(), 60);
  const double inertia = 4 * kPi * std::pow(0.5, 4) / 2;
  EXPECT_NEAR(double{world->Read(0).velocity.y()}, -10 * 2 / (2 + inertia / 0.25), 5e-3);
  EXPECT_NEAR(double{world->Read(0).position.y()} + 0.5 * AngleOf(*world, 1), 0, 1e-4);
  EXPECT_LT(DriftOf(*world), 1e-4);
}

/// Loads of 3 and 1 kg (and of `ratio`) under two points 10 m up.
std::unique_ptr<World> Atwood(double ratio, const std::string& rest = "") {
  return SmallWorld(Named("left", "box = [1, 1]\ndensity = 3\nposition = [-2, 0]") +
                    Named("right", "box = [1, 1]\nposition = [2, 0]") +
                    Joined("rope", "pulley",
                           "a = \"left\"\nb = \"right\"\nground_a = [-2, 10]\n"
                           "ground_b = [2, 10]\nratio = " +
                               FloatDigits(ratio) + "\n" + rest));
}

TEST(Couplings, AtwoodsMachineFallsWithItsShareOfGravity) {
  const auto world = Atwood(1);
  Steps(world.get(), 60);
  EXPECT_NEAR(double{world->Read(0).velocity.y()}, -10.0 * (3 - 1) / (3 + 1), 1e-3);
  EXPECT_NEAR(double{world->Read(1).velocity.y()}, 10.0 * (3 - 1) / (3 + 1), 1e-3);
  EXPECT_LT(DriftOf(*world), 1e-4);
}

TEST(Couplings, ARatioIsABlockAndTackle) {
  // l1 + 2 l2 is constant: v1 = -2 v2, and a2 = (m2 - 2 m1) / (m2 + 4 m1) g, downwards.
  const auto world = Atwood(2);
  Steps(world.get(), 60);
  const double down = 10.0 * (1 - 2 * 3) / (1 + 4 * 3);
  EXPECT_NEAR(double{world->Read(1).velocity.y()}, -down, 2e-3);
  EXPECT_NEAR(double{world->Read(0).velocity.y()}, 2 * down, 2e-3);
  EXPECT_LT(DriftOf(*world), 1e-4);
}

TEST(Couplings, APulleysLengthIsItsOwn) {
  const auto world = Atwood(1, "length = 19");
  Steps(world.get(), 10);
  const double left = 10 - double{world->Read(0).position.y()};
  const double right = 10 - double{world->Read(1).position.y()};
  EXPECT_NEAR(left + right, 19, 0.01);
}

TEST(Couplings, AGearIsRemovedWithOneOfItsJoints) {
  for (const int broken : {0, 1}) {
    const auto world = SmallWorld(Gearbox("motor = {speed = 3, torque = 100}"), "", kWeightless);
    Steps(world.get(), 60);
    ASSERT_TRUE(world->Apply({Edit(BreakEdit{broken})}).has_value());
    EXPECT_TRUE(world->scene().joints[2].gone) << broken;
    EXPECT_FALSE(world->scene().joints[1 - broken].gone) << broken;
    const float before = world->Read(1).spin;
    Steps(world.get(), 60);
    EXPECT_EQ(world->Read(1).spin, before) << "nothing turns it any more";
    EXPECT_EQ(JointMeter(world->scene(), world->composition()).Drifts({{}, {}}).size(), 1u);
  }
}

TEST(Couplings, AGearIsRemovedWithAPartOfItsJoints) {
  const auto world = SmallWorld(Gearbox(""), "", kWeightless);
  ASSERT_TRUE(world->Apply({Edit(RemoveEdit{1})}).has_value());
  EXPECT_TRUE(world->scene().joints[2].gone);
  EXPECT_FALSE(world->scene().joints[1].gone);
  Steps(world.get(), 10);
}

TEST(Couplings, BondsDoNotMoveAGearsWheels) {
  const auto world = SmallWorld(Gearbox("motor = {speed = 3, torque = 100}") +
                                    Named("lump", "circle = 0.1\nposition = [20, 0]"),
                                "", kWeightless);
  Steps(world.get(), 60);
  const double turned = AngleOf(*world, 1);
  // The bond moves the small wheel in the scene: its pose there is no longer the start's.
  BondEdit bond;
  bond.a = 3;
  bond.b = 1;
  bond.position = {0.5f, 0};
  bond.angle = 1;
  ASSERT_TRUE(world->Apply({Edit(bond)}).has_value());
  ASSERT_NE(world->scene().joints[0].turn, 0);
  EXPECT_LT(DriftOf(*world), 1e-3);
  Steps(world.get(), 1);
  EXPECT_NEAR(AngleOf(*world, 1), turned - 1.5 / 60, 2e-3);
  EXPECT_LT(DriftOf(*world), 1e-3);
}

TEST(Couplings, AFrameThatBecomesOneBodyWithAWheelLetsTheOtherTurn) {
  const auto world = SmallWorld(Gearbox("motor = {speed = 3, torque = 100}"), "", kWeightless);
  BondEdit bond;
  bond.a = 0;
  bond.b = 2;
  bond.position = {3, -5};
  ASSERT_TRUE(world->Apply({Edit(bond)}).has_value());
  Steps(world.get(), 60);
  EXPECT_NEAR(double{world->Read(0).spin}, 3, 1e-3);
}

/// Ticks after going back to the eighth barrier that came out differently.
int TicksThatDiffer(const std::string& text) {
  World world(ParseScene(text, "s.toml"));
  std::vector<WorldSnapshot> barriers;
  std::vector<std::uint64_t> hashes;
  const auto step = [&world] {
    world.Step();
    const WorldSnapshot barrier = world.tick() % 3 == 0 ? world.Barrier() : WorldSnapshot();
    return barrier;
  };
  while (world.tick() < 120) {
    const WorldSnapshot barrier = step();
    if (world.tick() % 3 == 0) barriers.push_back(barrier);
    hashes.push_back(world.Hash());
  }
  EXPECT_TRUE(world.Restore(barriers[7]).ok());
  int different = 0;
  while (world.tick() < 120) {
    step();
    if (world.Hash() != hashes[static_cast<std::size_t>(world.tick() - 1)]) ++different;
  }
  return different;
}

TEST(Couplings, ReplayBitForBitFromABarrier) {
  const std::string weights =
      Named("ground", "chain = [[-20, -3], [20, -3]]") +
      Named("left", "box = [1, 1]\ndensity = 3\nposition = [-2, 2]\nspin = 1") +
      Named("right", "box = [1, 1]\nposition = [2, 0]\nvelocity = [1, 0]") +
      Joined("rope", "pulley",
             "a = \"left\"\nb = \"right\"\nground_a = [-2, 9]\nground_b = [2, 9]\nratio = 1.5\n"
             "anchor_a = [-2.2, 2.5]");
  EXPECT_EQ(TicksThatDiffer(weights), 0);
  EXPECT_EQ(TicksThatDiffer(Gearbox("motor = {speed = 3, torque = 40}") +
                            Named("box", "box = [1, 1]\nposition = [-0.6, 3]")),
            0);
}

/// True if a box of 1 kg, glued under the end of a rope (b's, with ratio 2), falls off.
bool TearsOff(double strength) {
  const std::string hook = "box = [0.4, 0.4]\ndensity = 6.25\nposition = [2, 0]";
  const auto world = SmallWorld(
      Named("weight", "box = [1, 1]\nposition = [-2, 0]") + Named("hook", hook) +
      Named("box", "box = [1, 1]\nposition = [2, -0.7]") +
      Joined("rope", "pulley",
             "a = \"weight\"\nb = \"hook\"\nanchor_b = [2, 0]\nground_a = [-2, 10]\n"
             "ground_b = [2, 10]\nratio = 2") +
      Joined("glue", "glue", "a = \"hook\"\nb = \"box\"\nstrength = " + FloatDigits(strength)));
  for (int tick = 0; tick < 60; ++tick) {
    world->Step();
    if (!world->ProposeEdits().empty()) return true;
  }
  return false;
}

TEST(Couplings, ARopeLoadsTheGlueAtEitherEnd) {
  // 1 kg hold 2 kg in balance by a ratio of 2: the glue bears the lower one's 10 N.
  EXPECT_FALSE(TearsOff(10.2));
  EXPECT_TRUE(TearsOff(9.8));
}

}  // namespace couplings_test
}  // namespace seam
