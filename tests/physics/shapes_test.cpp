/// Capsules, wedges, segments and polygons of many corners: mass by integration, and how they rest,
/// slide and roll.

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/geometry.h"
#include "common/physics/world.h"
#include "common/scene/mass.h"
#include "tests/support/small_world.h"

namespace seam {
namespace shapes_test {

const char* kGround = "[[part]]\nname = \"ground\"\nchain = [[-50, 0], [50, 0]]\n";

/// `corners` of a regular polygon around the origin, as a scene writes them.
std::string Regular(int corners, double radius, bool clockwise) {
  std::string text = "polygon = [";
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * kPi * i / corners * (clockwise ? -1 : 1);
    text += "[" + FloatDigits(radius * std::cos(angle)) + ", " +
            FloatDigits(radius * std::sin(angle)) + "],";
  }
  return text + "]\n";
}

Part OnlyPart(const std::string& shape) {
  return ParseScene("[[part]]\nname = \"p\"\n" + shape, "shape.toml").parts[0];
}

/// Mass properties by summing over small squares.
MassProperties Summed(const Part& part, bool (*inside)(const Part&, double, double)) {
  const double side = 0.002, reach = 2;
  MassProperties sum;
  const int cells = static_cast<int>(2 * reach / side);
  for (int i = 0; i < cells; ++i) {
    for (int k = 0; k < cells; ++k) {
      const double x = -reach + side * (i + 0.5), y = -reach + side * (k + 0.5);
      if (!inside(part, x, y)) continue;
      const double mass = double{part.material.density} * side * side;
      sum.mass += mass;
      sum.centre += mass * Eigen::Vector2d(x, y);
      sum.inertia += mass * (x * x + y * y + side * side / 6);
    }
  }
  sum.centre /= sum.mass;
  sum.inertia -= sum.mass * sum.centre.squaredNorm();
  return sum;
}

TEST(Shapes, ACapsulesMassIsTheIntegralOverIt) {
  const Part part = OnlyPart("capsule = [1.5, 0.4]\ndensity = 3\n");
  const MassProperties exact = PartProperties(part);
  const MassProperties sum = Summed(part, [](const Part& p, double x, double y) {
    const double beyond = std::max(0.0, std::fabs(x) - double{p.points[1].x()});
    return std::hypot(beyond, y) < double{p.radius};
  });
  EXPECT_NEAR(exact.mass, sum.mass, 2e-3 * sum.mass);
  EXPECT_NEAR(exact.inertia, sum.inertia, 2e-3 * sum.inertia);
  EXPECT_NEAR(exact.centre.norm(), 0, 1e-9);
}

TEST(Shapes, AWedgesMassIsATrianglesOnEitherSide) {
  for (const double width : {3.0, -3.0}) {
    const Part part = OnlyPart("wedge = [" + FloatDigits(width) + ", 1.5]\ndensity = 2\n");
    const MassProperties wedge = PartProperties(part);
    EXPECT_NEAR(wedge.mass, 2 * 3 * 1.5 / 2, 1e-9);
    // A third of the way from the right angle, which is on the lower right, or left.
    EXPECT_NEAR(wedge.centre.x(), width / 2 - width / 3, 1e-9);
    EXPECT_NEAR(wedge.centre.y(), -0.25, 1e-9);
    EXPECT_NEAR(wedge.inertia, wedge.mass * (9 + 2.25) / 18, 1e-9);
  }
}

TEST(Shapes, ACapsuleLiesAsItsBoxAndItsDiscsTogether) {
  const auto world = SmallWorld(std::string(kGround) +
                                    "[[part]]\nname = \"pill\"\ncapsule = [1, 0.3]\n"
                                    "position = [0, 0.6]\nangle = 0.4\n",
                                "skin = 0.0025");
  Steps(world.get(), 240);
  const BodyState rest = world->Read(0);
  EXPECT_NEAR(rest.position.y(), 0.3, 5e-3) << "what falls stops anywhere within the slop";
  EXPECT_NEAR(rest.angle, 0, 2e-3);
  EXPECT_LT(rest.velocity.norm(), 1e-3f);
}

TEST(Shapes, AStockCapsuleRestsAboveTheGroundAsBoxesDo) {
  const auto world = SmallWorld(std::string(kGround) +
                                "[[part]]\nname = \"pill\"\ncapsule = [1, 0.3]\n"
                                "position = [0, 0.34]\n");
  Steps(world.get(), 240);
  EXPECT_NEAR(world->Read(0).position.y(), 0.3 + 0.01 - 0.0025, 3e-3);  // a rim less half a slop
  EXPECT_NEAR(world->Read(0).angle, 0, 2e-3);
}

TEST(Shapes, BodiesSlideDownAWedgeByItsSlope) {
  // a = g (sin - mu cos) with tan = 3/4, mu = 0.25: 10 (0.6 - 0.2) = 4 m/s^2 along the slope.
  const auto world = SmallWorld(
      "[[part]]\nname = \"ramp\"\nwedge = [40, 30]\nanchored = true\nfriction = 0.25\n"
      "[[part]]\nname = \"box\"\nbox = [1, 1]\nfriction = 0.25\nangle = 0.6435011\n"
      "position = [3.693, 3.41]\n");
  Steps(world.get(), 60);
  const Vec2 before = world->Read(0).velocity;
  Steps(world.get(), 60);
  const Vec2 gained = world->Read(0).velocity - before;
  EXPECT_NEAR(gained.x(), -4 * 0.8, 0.05);
  EXPECT_NEAR(gained.y(), -4 * 0.6, 0.05);
}

TEST(Shapes, AWedgeOfNegativeWidthRisesToTheLeft) {
  const auto world = SmallWorld(
      "[[part]]\nname = \"ramp\"\nwedge = [-40, 30]\nanchored = true\n"
      "[[part]]\nname = \"ball\"\ncircle = 0.5\nposition = [-3, 3.2]\n");
  Steps(world.get(), 60);
  EXPECT_GT(world->Read(0).velocity.x(), 2);
}

TEST(Shapes, ASegmentIsSolidFromBothSides) {
  const auto world = SmallWorld(
      "[[part]]\nname = \"edge\"\nsegment = [[-5, 0], [5, 0]]\n"
      "[[part]]\nname = \"above\"\nbox = [1, 1]\nposition = [-2, 2]\nvelocity = [0, -8]\n"
      "[[part]]\nname = \"below\"\nbox = [1, 1]\nposition = [2, -2]\nvelocity = [0, 12]\n");
  float highest = -10;
  for (int t = 0; t < 240; ++t) {
    world->Step();
    highest = std::max(highest, world->Read(1).position.y());
  }
  EXPECT_NEAR(world->Read(0).position.y(), 0.5, 0.03);
  EXPECT_NEAR(highest, -0.5, 0.15) << "it was going to rise to 5.2 m";
}

TEST(Shapes, APolygonOfManyCornersIsOneBodyOfTheRightMass) {
  for (const int corners : {9, 17, 33, 64}) {
    for (const bool clockwise : {false, true}) {
      const Part part = OnlyPart(Regular(corners, 1, clockwise));
      // Regular polygon: A = n/2 R^2 sin(2 pi/n), I = m R^2/6 (1 + 2 cos^2(pi/n)).
      const double area = corners / 2.0 * std::sin(2 * kPi / corners);
      const MassProperties got = PartProperties(part);
      EXPECT_NEAR(got.mass, area, 1e-5) << corners;
      const double cosine = std::cos(kPi / corners);
      EXPECT_NEAR(got.inertia, area * (1 + 2 * cosine * cosine) / 6, 1e-5) << corners;
    }
  }
}

TEST(Shapes, AWheelOfManyCornersRollsDownAsADisc) {
  // A rolling disc gains two thirds of a sliding one: m r^2/2 beside m r^2.
  const auto world = SmallWorld(
      "[[part]]\nname = \"slope\"\nchain = [[-50, 8], [50, -8]]\nfriction = 1\n"
      "[[part]]\nname = \"wheel\"\n" +
      Regular(64, 1, false) + "position = [0, 1.04]\nfriction = 1\n");
  Steps(world.get(), 60);
  const double before = double{world->Read(0).velocity.norm()};
  Steps(world.get(), 60);
  const double gained = double{world->Read(0).velocity.norm()} - before;
  const double slope = std::atan(0.16);
  EXPECT_NEAR(gained, 10 * std::sin(slope) * 2 / 3, 0.1);
  EXPECT_NEAR(double{world->Read(0).spin}, -(before + gained), 0.05);
}

TEST(Shapes, PiecesOfOnePartHaveImpulsesOfTheirOwnInABarrier) {
  const Scene scene =
      ParseScene(std::string(kGround) +
                     "[[part]]\nname = \"a\"\ncapsule = [1, 0.3]\nposition = [0, 0.32]\n"
                     "[[part]]\nname = \"b\"\ncapsule = [1, 0.3]\nposition = [0.2, 0.95]\n"
                     "[[part]]\nname = \"c\"\n" +
                     Regular(20, 0.8, false) + "position = [0.3, 2.1]\n" +
                     "[[part]]\nname = \"edge\"\nsegment = [[-2, 0], [-2, 3]]\n",
                 "pieces.toml");
  World world(scene);
  std::vector<WorldSnapshot> barriers;
  std::vector<std::uint64_t> hashes;
  for (int t = 1; t <= 120; ++t) {
    world.Step();
    if (t % 2 == 0) barriers.push_back(world.Barrier());
    hashes.push_back(world.Hash());
  }
  EXPECT_TRUE(world.Restore(barriers[9]).ok());
  while (world.tick() < 120) {
    world.Step();
    if (world.tick() % 2 == 0) world.Barrier();
    ASSERT_EQ(world.Hash(), hashes[static_cast<std::size_t>(world.tick() - 1)]) << world.tick();
  }
}

}  // namespace shapes_test
}  // namespace seam
