/// How bodies rest in water, against Archimedes and the known stability of floating bodies.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/water_world.h"

namespace seam {
namespace water_rest_test {

constexpr double kDegree = M_PI / 180;

/// After `seconds` of a single body in a thick sea, stepped at 240 Hz.
BodyState Settled(const std::string& part, double seconds, const std::string& sea = "") {
  const auto world = SmallWorld(Floater("p", part) + Sea("viscosity = 2\n" + sea), "tick_hz = 240");
  Steps(world.get(), static_cast<int>(240 * seconds));
  return world->Read(0);
}

std::string Square(double density, double angle) {
  return "box = [1, 1]\ndensity = " + FloatDigits(density) + "\nangle = " + FloatDigits(angle);
}

/// Lean of a settled square from upright, 0..45 degrees.
double Lean(double density, double start_angle, double seconds = 40) {
  const double angle = double{Settled(Square(density, start_angle), seconds).angle};
  return std::fabs(std::remainder(angle, M_PI / 2)) / kDegree;
}

TEST(WaterRest, ABoxSinksByItsShareOfTheWatersDensity) {
  for (const char* method :
       {"method = \"exact\"", "method = \"voxel4\"", "method = \"voxel\"\nn = 5"}) {
    for (const double density : {0.1, 0.5, 0.9}) {
      const BodyState rest = Settled(
          "box = [3, 0.8]\nposition = [0, 0.5]\ndensity = " + FloatDigits(density), 20, method);
      EXPECT_NEAR(rest.position.y(), 0.4 - 0.8 * density, 1e-4) << method << ' ' << density;
      EXPECT_NEAR(rest.angle, 0, 1e-4);
    }
  }
}

TEST(WaterRest, DraughtIsTheRatioOfDensities) {
  const BodyState rest = Settled("box = [3, 1]\ndensity = 6", 120, "density = 10");
  EXPECT_NEAR(rest.position.y(), 0.5 - 0.6, 1e-4);
}

TEST(WaterRest, ADiscOfHalfTheDensityLiesHalfIn) {
  EXPECT_NEAR(Settled("circle = 0.7\nposition = [0, 1]\ndensity = 0.5", 20).position.y(), 0, 1e-4);
  // A segment of depth d has the area r^2 (a - sin a cos a), cos a = 1 - d/r: a = 60 degrees here.
  const double share = (M_PI / 3 - std::sin(M_PI / 3) * 0.5) / M_PI;
  const BodyState low = Settled("circle = 1\ndensity = " + FloatDigits(share), 20);
  EXPECT_NEAR(low.position.y(), 0.5, 1e-4);
}

TEST(WaterRest, ACapsuleLiesFlatAndHalfIn) {
  const BodyState rest =
      Settled("capsule = [2, 0.3]\nposition = [0, 0.5]\nangle = 0.3\ndensity = 0.5", 40);
  EXPECT_NEAR(rest.position.y(), 0, 1e-3);
  EXPECT_NEAR(rest.angle, 0, 1e-3);
}

TEST(WaterRest, ASquareFloatsUprightWhileItIsLightOrHeavyEnough) {
  // Upright iff s < (3 - sqrt 3)/6 = 0.21132 or s > 0.78868.
  for (const double s : {0.1, 0.2, 0.8, 0.9}) EXPECT_NEAR(Lean(s, 0.2), 0, 0.1) << s;
}

TEST(WaterRest, ASquareOfMiddlingDensityFloatsOnItsCorner) {
  for (const double s : {0.3, 0.5, 0.7}) EXPECT_NEAR(Lean(s, 0.2), 45, 0.1) << s;
}

TEST(WaterRest, ASquareOfADensityBetweenLeansByTheKnownAngle) {
  // tan^2 = 12 s (1 - s) - 2 up to s = 1/4, then tan = t2/t1 with t^2 - 3/2 t + 2 s = 0.
  const auto known = [](double s) {
    if (s <= 0.25) return std::atan(std::sqrt(12 * s * (1 - s) - 2)) / kDegree;
    const double root = std::sqrt(2.25 - 8 * s);
    return std::atan((1.5 - root) / (1.5 + root)) / kDegree;
  };
  EXPECT_NEAR(known(0.22), 13.67, 0.01);
  EXPECT_NEAR(known(0.27), 33.69, 0.01);
  for (const double s : {0.22, 0.23, 0.24, 0.25, 0.26, 0.27}) {
    EXPECT_NEAR(Lean(s, 0.3, 60), known(s), 0.1) << s;
    EXPECT_NEAR(Lean(1 - s, 0.3, 60), known(s), 0.1) << "as much air as water: " << 1 - s;
  }
}

TEST(WaterRest, AHeavyCornerGoesDown) {
  for (const double side : {-0.35, 0.35}) {
    const std::string x = FloatDigits(side);
    const auto world =
        SmallWorld(Floater("box", "box = [1, 1]\ndensity = 0.4") +
                   Floater("lead", "box = [0.2, 0.2]\ndensity = 3\nposition = [" + x + ", 0.35]") +
                   "[[joint]]\nname = \"w\"\nkind = \"weld\"\na = \"box\"\nb = \"lead\"\n" +
                   Sea("viscosity = 2"));
    Steps(world.get(), 60 * 20);
    const BodyState rest = world->Read(0);
    const Vec2 arm(side, 0.35f);
    const float low = std::sin(rest.angle) * arm.x() + std::cos(rest.angle) * arm.y();
    EXPECT_LT(low, -0.3f) << "the lead is below the middle, angle " << rest.angle;
    EXPECT_LT(side * double{rest.angle}, 0) << "and it went down on its own side";
    EXPECT_NEAR(rest.spin, 0, 1e-3);
  }
}

TEST(WaterRest, AHeavierBodySinksToTheBottomAndRestsThere) {
  const auto world =
      SmallWorld(Floater("bed", "box = [20, 1]\nposition = [0, -5.5]\nanchored = true") +
                 Floater("stone", "box = [1, 1]\nposition = [0, -0.5]\ndensity = 1.5") + Sea());
  Steps(world.get(), 60 * 10);
  EXPECT_NEAR(world->Read(0).position.y(), -4.5, 0.02);
  EXPECT_NEAR(world->Read(0).velocity.norm(), 0, 1e-3);
}

TEST(WaterRest, ARaftSinksByItsLoad) {
  // Floaters touch floaters: a crate of 0.5 kg on 4 kg that are 8 m^2 large.
  const auto world =
      SmallWorld(Floater("raft", "box = [8, 1]\ndensity = 0.5") +
                     Floater("crate", "box = [1, 1]\ndensity = 0.5\nposition = [0, 1.2]") +
                     Sea("viscosity = 2"),
                 "substeps = 4");
  Steps(world.get(), 60 * 20);
  EXPECT_NEAR(world->Read(0).position.y(), 0.5 - 4.5 / 8, 2e-3);
  EXPECT_NEAR(world->Read(1).position.y() - world->Read(0).position.y(), 1, 0.02);
}

TEST(WaterRest, ThePartBesideTheWaterIsNotLifted) {
  // Half of a plank lies over the edge of the pool: it tips into the dry.
  const auto world =
      SmallWorld(Floater("plank", "box = [4, 0.5]\ndensity = 0.5") +
                 "[[water]]\nname = \"pool\"\nbox = [10, 10]\nposition = [-5, -5]\n");
  Steps(world.get(), 30);
  EXPECT_LT(world->Read(0).angle, -0.05);
}

}  // namespace water_rest_test
}  // namespace seam
