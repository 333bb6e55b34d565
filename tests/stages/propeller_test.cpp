/// Propellers and paddle wheels push only by the water, and by its law.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "common/base/geometry.h"
#include "common/scene/forces.h"
#include "common/stages/water/propeller_law.h"
#include "tests/support/water_world.h"

namespace seam {
namespace propeller_test {

/// Bollard pull is measured on a hull of 2000 kg without gravity, which hardly moves: 40 m x 0.5 m
/// far above the level 0.
const char* const kBench = "gravity = [0, 0]\nsize_max = 50\n";
const char* const kHull =
    "[[part]]\nname = \"hull\"\nbox = [40, 0.5]\nposition = [0, 8]\ndensity = 100\n";
constexpr float kHullMass = 2000;

/// A disc of 1 m, pitch 0.6 m, whose middle is at the height `y`.
std::string Mounted(double y, double turns, const std::string& more = "") {
  return std::string(kHull) + "[[propeller]]\nname = \"screw\"\npart = \"hull\"\nat = [0, " +
         std::to_string(y - 8) +
         "]\ndiameter = 1\npitch = 0.6\nsolidity = 0.5\nturns = " + std::to_string(turns) + "\n" +
         more + "\n";
}

/// Mean force on the hull over a second that begins after `settle` ticks, N.
double Pull(World* world, int settle = 10) {
  Steps(world, settle);
  const double before = static_cast<double>(world->Read(0).velocity.x());
  Steps(world, 60);
  return static_cast<double>(kHullMass) *
         (static_cast<double>(world->Read(0).velocity.x()) - before);
}

double ScrewPull(double y, double turns, const std::string& more = "") {
  const auto world = SmallWorld(Sea() + Mounted(y, turns, more), "", kBench);
  return Pull(world.get());
}

TEST(Propeller, PullsByTheSquareOfItsTurns) {
  const double one = ScrewPull(-2, 1);
  EXPECT_GT(one, 0.01);
  for (const double turns : {1.0, 2.0, 4.0, 8.0, 16.0}) {
    const double pull = ScrewPull(-2, turns);
    std::printf("[          ] propeller, %4.1f turns/s: bollard pull %8.4f N, %.5f N s2\n", turns,
                pull, pull / (turns * turns));
    EXPECT_NEAR(pull / (turns * turns), one, 0.02 * one) << turns;
    EXPECT_NEAR(ScrewPull(-2, -turns), -pull, 0.02 * pull) << "astern";
  }
  // rho/2 Cn solidity L (n P)^2, L the integral of cos^3 by a sum of a thousand strips.
  double span = 0;
  for (int i = 0; i < 1000; ++i) {
    const double r = (i + 0.5) / 1000 * 0.5, pitched = 0.6 / (2 * kPi * r);
    span += 2 * 0.5 / 1000 * std::pow(1 + pitched * pitched, -1.5);
  }
  EXPECT_NEAR(EffectiveSpan(0.6, -0.5, 0.5), span, 1e-5);
  EXPECT_NEAR(one, 0.5 * 0.5 * span * 0.36, 0.02 * one);
}

TEST(Propeller, PushesNothingInTheAirAndHalfAsMuchHalfImmersed) {
  EXPECT_EQ(ScrewPull(2, 16), 0) << "dry";
  const double whole = ScrewPull(-2, 8), half = ScrewPull(0, 8), less = ScrewPull(0.25, 8);
  EXPECT_NEAR(half, whole / 2, 0.02 * whole);
  EXPECT_LT(less, half);
  EXPECT_GT(less, 0);
}

TEST(Propeller, PushesNothingInWaterWithoutResistance) {
  const auto world = SmallWorld(
      Sea("drag_normal = 0\ndrag_tangent = 0\nviscosity = 0") + Mounted(-2, 8), "", kBench);
  EXPECT_EQ(Pull(world.get()), 0);
}

TEST(Propeller, TurnsItsHullByTheLever) {
  const auto world = SmallWorld(Sea() + Mounted(-2, 8), "", kBench);
  Steps(world.get(), 60);
  // 10 m below the middle, forwards: the bow comes up, by T 10 m over I.
  const double inertia = 2000.0 * (40.0 * 40 + 0.5 * 0.5) / 12;
  const double pull = static_cast<double>(kHullMass * world->Read(0).velocity.x());
  EXPECT_NEAR(static_cast<double>(world->Read(0).spin), pull * 10 / inertia,
              0.02 * pull * 10 / inertia);
}

TEST(Propeller, IsHeldBackByTheTorqueOfItsShaft) {
  // T P / (2 pi) = Q.
  const double free = ScrewPull(-2, 16), held = ScrewPull(-2, 16, "torque = 0.1");
  EXPECT_GT(free, 2 * held);
  EXPECT_NEAR(held, 0.1 * 2 * kPi / 0.6, 0.02 * held);
}

TEST(Propeller, DrivesABoatAsFastAsTheWaterLetsIt) {
  // A box of 4 m x 0.4 m under water, without gravity: its end and its two long sides.
  const auto world =
      SmallWorld(Sea("viscosity = 0.2") +
                     "[[part]]\nname = \"hull\"\nbox = [4, 0.4]\nposition = [-80, -5]\n"
                     "[[propeller]]\nname = \"screw\"\npart = \"hull\"\ndiameter = 1\npitch = 0.6\n"
                     "solidity = 0.5\nturns = 6\n",
                 "", "gravity = [0, 0]\n");
  Steps(world.get(), 1800);
  const auto v = static_cast<double>(world->Read(0).velocity.x());
  EXPECT_GT(v, 0.5);
  EXPECT_LT(v, 3.6) << "never as fast as it would advance through something solid";
  Screw screw;
  screw.diameter = 1, screw.pitch = 0.6f, screw.solidity = 0.5f;
  const double thrust = PropellerThrust(screw, EffectiveSpan(0.6, -0.5, 0.5), 0.5, 6, v);
  // The skin of 1 cm belongs to no edge: the water's edges are the shape's.
  const double drag = 0.5 * 0.4 * v * v + 0.5 * 0.05 * 8 * v * v + 0.2 * 1.6 * v;
  EXPECT_NEAR(thrust, drag, 0.03 * drag) << v << " m/s";
}

TEST(Propeller, FollowsItsPlayerAndReplaysBitForBit) {
  World world(ParseScene(
      "[[player]]\nname = \"ann\"\nvehicle = \"boat\"\n" + Sea("flow = [0.3, 0]") +
          Floater("boat", "box = [4, 0.6]\nposition = [0, 0]\ndensity = 0.5") +
          "[[propeller]]\nname = \"screw\"\npart = \"boat\"\nat = [-2.2, -0.5]\ndiameter = 0.6\n"
          "pitch = 0.5\nturns = 9\nplayer = \"ann\"\n",
      "s.toml"));
  const auto step = [&world] {
    const auto t = static_cast<int>(world.tick());
    world.SetInput(0, {static_cast<std::int8_t>(t % 50 < 35 ? 127 : -60), 0, 0});
    world.Step();
  };
  std::vector<WorldSnapshot> barriers;
  std::vector<std::uint64_t> hashes;
  while (world.tick() < 150) {
    step();
    if (world.tick() % 3 == 0) barriers.push_back(world.Barrier());
    hashes.push_back(world.Hash());
  }
  EXPECT_GT(world.Read(0).position.x(), 1);
  ASSERT_TRUE(world.Restore(barriers[9]).ok());
  while (world.tick() < 150) {
    step();
    if (world.tick() % 3 == 0) world.Barrier();
    ASSERT_EQ(world.Hash(), hashes[static_cast<std::size_t>(world.tick() - 1)]) << world.tick();
  }
}

/// A wheel of three crossed boards of 1.6 m under the hull's middle, its axle at the height `y`.
std::string Wheel(double y, double turns, double density) {
  const std::string at =
      "position = [0, " + std::to_string(y) + "]\ndensity = " + std::to_string(density) + "\n";
  std::string text = std::string(kHull) + "[[part]]\nname = \"hub\"\ncircle = 0.2\n" + at;
  for (int i = 0; i < 3; ++i) {
    const std::string n = std::to_string(i);
    text += "[[part]]\nname = \"board" + n + "\"\nbox = [1.6, 0.08]\n" + at +
            "angle = " + std::to_string(i * kPi / 3) + "\n";
    text +=
        "[[joint]]\nname = \"w" + n + "\"\nkind = \"weld\"\na = \"hub\"\nb = \"board" + n + "\"\n";
  }
  return text +
         "[[joint]]\nname = \"axle\"\nkind = \"hinge\"\na = \"hull\"\nb = \"hub\"\nmotor = " +
         "{speed = " + std::to_string(-2 * kPi * turns) + ", torque = 1000}\n";
}

double WheelPull(double y, double turns, double density = 8) {
  const auto world =
      SmallWorld(Sea("viscosity = 0") + Wheel(y, turns, density), "substeps = 4", kBench);
  return Pull(world.get(), 60);
}

TEST(PaddleWheel, PullsByTheSquareOfItsTurns) {
  const double one = WheelPull(0.2, 1);
  EXPECT_GT(one, 1);
  for (const double turns : {0.5, 1.0, 2.0, 3.0}) {
    const double pull = WheelPull(0.2, turns), light = WheelPull(0.2, turns, 1);
    std::printf(
        "[          ] paddle wheel, %3.1f turns/s: bollard pull %7.4f N, %.4f N s2; "
        "a wheel of density 1: %7.4f N\n",
        turns, pull, pull / (turns * turns), light);
    EXPECT_NEAR(pull / (turns * turns), one, 0.1 * one) << turns;
  }
}

TEST(PaddleWheel, PushesNothingInTheAirAndLessWhereLessIsWet) {
  EXPECT_NEAR(WheelPull(2, 2), 0, 0.02) << "dry";
  const double half = WheelPull(0, 2), less = WheelPull(0.5, 2);
  EXPECT_GT(less, 0.1);
  EXPECT_LT(less, half);
  EXPECT_NEAR(WheelPull(-3, 2), 0, 0.05 * half) << "wholly under water both ways are the same";
}

TEST(PaddleWheel, TurnsItsHullTheOtherWay) {
  // In the air the wheel's angular momentum is the opposite of the hull's.
  const auto world = SmallWorld(Wheel(2, 2, 1), "substeps = 4", kBench);
  Steps(world.get(), 60);
  const double hull = 2000.0 * (40.0 * 40 + 0.5 * 0.5) / 12;
  const double board = 1.6 * 0.08;
  const double wheel = 3 * board * (1.6 * 1.6 + 0.08 * 0.08) / 12 + kPi * 0.04 * 0.04 / 2;
  const double turned = hull * static_cast<double>(world->Read(0).spin);
  EXPECT_NEAR(turned, wheel * 2 * kPi * 2, 0.1 * wheel * 2 * kPi * 2);
  // In the water the same wheel goes on turning it: by the water's torque on the boards.
  const auto wet = SmallWorld(Sea() + Wheel(0.2, 2, 1), "substeps = 4", kBench);
  Steps(wet.get(), 60);
  EXPECT_GT(hull * static_cast<double>(wet->Read(0).spin), 3 * turned);
}

}  // namespace propeller_test
}  // namespace seam
