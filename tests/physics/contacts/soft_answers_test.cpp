/// Soft contacts against exact answers: sliding, rolling, spinning, bouncing and leaning things.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/small_world.h"

namespace seam {
namespace soft_answers_test {

constexpr const char* kSoft = "contacts = \"soft\"\n";

std::unique_ptr<World> SoftWorld(const std::string& parts, const std::string& solver = "") {
  return SmallWorld(parts, kSoft + solver, "gravity = [0, -10]");
}

std::string Ground(double friction, double slope = 0) {
  const double c = std::cos(slope), s = std::sin(slope);
  return "[[part]]\nname = \"ground\"\nchain = [[" + FloatDigits(-5 * c) + ", " +
         FloatDigits(5 * s) + "], [" + FloatDigits(90 * c) + ", " + FloatDigits(-90 * s) +
         "]]\nfriction = " + FloatDigits(friction) + "\n";
}

std::string Thing(const std::string& shape, double x, double y, const std::string& rest) {
  return "[[part]]\nname = \"thing\"\n" + shape + "\nposition = [" + FloatDigits(x) + ", " +
         FloatDigits(y) + "]\n" + rest + "\n";
}

/// Coulomb: it stops after v^2/(2 mu g).
TEST(SoftAnswers, ASlidingBlockStopsWhereFrictionEndsIt) {
  for (const double speed : {4.0, 8.0, 12.0, 16.0}) {
    for (const double friction : {0.3, 0.5, 0.9}) {
      const std::string rest =
          "friction = " + FloatDigits(friction) + "\nvelocity = [" + FloatDigits(speed) + ", 0]";
      const auto world = SoftWorld(Ground(friction) + Thing("box = [1, 1]", 0, 0.5, rest));
      Steps(world.get(), 400);
      const double right = speed * speed / (20 * friction);
      EXPECT_NEAR(world->Read(0).position.x(), right, 0.005) << speed << ' ' << friction;
      EXPECT_LT(world->Read(0).velocity.norm(), 1e-3f);
    }
  }
}

/// I = m r^2/2: it slides for v/(3 mu g), then rolls at 2/3 v.
TEST(SoftAnswers, ASlidingDiscBeginsToRoll) {
  for (const double speed : {4.0, 10.0}) {
    const std::string rest = "friction = 0.3\nvelocity = [" + FloatDigits(speed) + ", 0]";
    const auto world = SoftWorld(Ground(0.3) + Thing("circle = 0.5", 0, 0.5, rest));
    Steps(world.get(), 240);
    const double slides = speed / 9, t = 4;
    const double right = speed * slides - 1.5 * slides * slides + 2 * speed / 3 * (t - slides);
    const BodyState disc = world->Read(0);
    EXPECT_NEAR(disc.position.x(), right, 0.01) << speed;
    EXPECT_NEAR(disc.velocity.x(), 2 * speed / 3, 1e-3 * speed);
    EXPECT_NEAR(disc.velocity.x() + disc.spin * 0.5f, 0, 1e-3);
  }
}

/// Rolls as g sin t^2/3, and turns by that over its radius.
TEST(SoftAnswers, ARollingDiscDoesNotSlip) {
  for (const double slope : {0.1, 0.35, 0.6}) {
    const auto world =
        SoftWorld(Ground(0.9, slope) + Thing("circle = 0.5", 0.5 * std::sin(slope),
                                             0.5 * std::cos(slope), "friction = 0.9"));
    const Vec2 from = world->Read(0).position;
    Steps(world.get(), 240);
    const Vec2 along(static_cast<float>(std::cos(slope)), static_cast<float>(-std::sin(slope)));
    const float way = (world->Read(0).position - from).dot(along);
    EXPECT_NEAR(way, 10 * std::sin(slope) * 16 / 3, 0.005) << slope;
    EXPECT_NEAR(way + world->Read(0).angle * 0.5f, 0, 0.002) << slope;
  }
}

/// Garwin: spin about the point of contact stays, and a gripping ball leaves without slip.
TEST(SoftAnswers, ASpinningBallLeavesAWallWithoutSlip) {
  for (const double spin : {-6.0, 0.0, 3.0}) {
    const std::string rest =
        "friction = 1\nrestitution = 0.8\nvelocity = [4, -8]\nspin = " + FloatDigits(spin);
    const auto world = SmallWorld(
        "[[part]]\nname = \"wall\"\nbox = [90, 2]\nposition = [0, -1]\nanchored = true\n"
        "friction = 1\n" +
            Thing("circle = 0.5", 0, 2, rest),
        kSoft, "gravity = [0, 0]");
    Steps(world.get(), 60);
    const double right = (4 - 0.5 * spin / 2) * 2 / 3;
    const BodyState ball = world->Read(0);
    EXPECT_NEAR(ball.velocity.x(), right, 5e-4 * std::fabs(right)) << spin;
    EXPECT_NEAR(ball.spin, -right / 0.5, 1e-3 * std::fabs(right)) << spin;
    EXPECT_NEAR(ball.velocity.y(), 6.4, 0.01) << spin;
  }
}

/// m/s2 times m: of a ball of 0.5 m radius above the ground, per kg.
double BallEnergy(const World& world) {
  const BodyState ball = world.Read(0);
  const double speed = static_cast<double>(ball.velocity.y());
  return 10 * (static_cast<double>(ball.position.y()) - 0.5) + speed * speed / 2;
}

TEST(SoftAnswers, ABouncingBallKeepsTheSquareOfItsRestitution) {
  for (const double restitution : {0.5, 0.7, 0.9}) {
    for (const double height : {2.0, 5.0, 7.3}) {
      const auto world = SoftWorld(Ground(0) + Thing("circle = 0.5", 0, 0.5 + height,
                                                     "restitution = " + FloatDigits(restitution)));
      while (world->Read(0).velocity.y() <= 0 && world->tick() < 300) world->Step();
      const double left = BallEnergy(*world) / (10 * height);
      EXPECT_NEAR(left, restitution * restitution, 0.02 * left) << restitution << ' ' << height;
    }
  }
}

/// For ever: what a step would add comes back at each impact.
TEST(SoftAnswers, AnElasticThingComesBackToItsHeight) {
  for (const char* shape : {"circle = 0.5", "box = [1, 1]", "box = [0.3, 1]", "box = [4, 1]"}) {
    for (const double height : {0.5, 5.0}) {
      for (const char* solver : {"", "substeps = 3\n"}) {
        const auto world = SoftWorld(
            Ground(0) + Thing(shape, 0, 0.5 + height, "restitution = 1\nfriction = 0"), solver);
        float top = 0;
        for (int tick = 0; tick < 2400; ++tick) {
          world->Step();
          if (tick >= 2000) top = std::max(top, world->Read(0).position.y());
        }
        EXPECT_NEAR(top - 0.5, height, 0.02 * height) << shape << ' ' << height << ' ' << solver;
      }
    }
  }
}

/// Both corners come back at once: it neither turns nor gains.
TEST(SoftAnswers, ABoxThatLandsFlatKeepsTheSquareOfItsRestitution) {
  for (const double width : {0.1, 0.3, 1.0, 4.0}) {
    for (const double restitution : {0.5, 0.8, 0.95}) {
      const std::string shape = "box = [" + FloatDigits(width) + ", 1]";
      const auto world = SoftWorld(
          Ground(0.5) + Thing(shape, 0, 5.5, "restitution = " + FloatDigits(restitution)));
      while (world->Read(0).velocity.y() <= 0 && world->tick() < 300) world->Step();
      const double left = BallEnergy(*world) / 50;
      EXPECT_NEAR(left, restitution * restitution, 0.03) << width << ' ' << restitution;
      EXPECT_NEAR(world->Read(0).spin, 0, 1e-3) << width << ' ' << restitution;
    }
  }
}

TEST(SoftAnswers, NothingCreepsOnALiftThatGoesUpAndAcross) {
  for (const char* path : {"[[0, 0], [3, 2]]", "[[0, 0], [3, -2]]", "[[0, 0], [3, 0]]"}) {
    for (const char* solver : {"", "substeps = 3\n"}) {
      const auto world = SoftWorld(
          Thing("box = [0.6, 0.6]", 0.3, 0.55, "friction = 0.9") +
              "[[part]]\nname = \"lift\"\nbox = [6, 0.5]\nanchored = true\nfriction = 0.9\n"
              "[[joint]]\nname = \"way\"\nkind = \"kinematic\"\nb = \"lift\"\nperiod = 4\n"
              "ease = true\npath = " +
              path + "\n",
          solver);
      Steps(world.get(), 240);
      const float from = world->Read(0).position.x();
      Steps(world.get(), 2400);
      EXPECT_NEAR(world->Read(0).position.x(), from, 0.005) << path << ' ' << solver;
    }
  }
}

/// m: how far the top of six bricks falls that lean out by `share` of the harmonic limit.
float TopFalls(double share, double length, double height) {
  constexpr int kBricks = 6;
  std::string parts =
      "[[part]]\nname = \"table\"\nbox = [20, 1]\nposition = [-10, -0.5]\nanchored = true\n"
      "friction = 0.6\n";
  double edge = 0;
  for (int i = 0; i < kBricks; ++i) {
    edge += share * length / 2 / (kBricks - i);
    parts += "[[part]]\nname = \"brick" + std::to_string(i) + "\"\nbox = [" + FloatDigits(length) +
             ", " + FloatDigits(height) + "]\nposition = [" + FloatDigits(edge - length / 2) +
             ", " + FloatDigits((i + 0.5) * height) + "]\nfriction = 0.6\n";
  }
  const auto world = SoftWorld(parts);
  const float before = world->Read(kBricks - 1).position.y();
  Steps(world.get(), 1200);
  return before - world->Read(kBricks - 1).position.y();
}

TEST(SoftAnswers, LeaningBricksStandBelowTheHarmonicLimitOnly) {
  EXPECT_LT(TopFalls(0.97, 2, 0.5), 0.05f);
  EXPECT_GT(TopFalls(1.03, 2, 0.5), 1);
  EXPECT_LT(TopFalls(0.97, 4, 0.5), 0.05f);
  EXPECT_GT(TopFalls(1.03, 4, 0.5), 1);
}

TEST(SoftAnswers, FrictionHoldsABlockOnASlopeWithoutCreep) {
  for (const double slope : {0.2, 0.4}) {
    const double c = std::cos(slope), s = std::sin(slope);
    const auto world =
        SoftWorld(Ground(0.6, slope) + Thing("box = [1, 1]", 0.5 * s, 0.5 * c,
                                             "friction = 0.6\nangle = " + FloatDigits(-slope)));
    Steps(world.get(), 60);
    const Vec2 from = world->Read(0).position;
    Steps(world.get(), 1200);
    EXPECT_LT((world->Read(0).position - from).norm(), 5e-4f) << slope;
  }
}

TEST(SoftAnswers, ATowerStandsAndHardlySinks) {
  for (const int count : {5, 10, 20}) {
    std::string parts = Ground(0.6);
    for (int i = 0; i < count; ++i) {
      parts += "[[part]]\nname = \"box" + std::to_string(i) + "\"\nbox = [1, 1]\nposition = [0, " +
               FloatDigits(i + 0.5) + "]\nfriction = 0.6\n";
    }
    const auto world = SoftWorld(parts);
    Steps(world.get(), 900);
    for (int i = 0; i < count; ++i) {
      const float below = i == 0 ? -0.5f : world->Read(i - 1).position.y();
      EXPECT_NEAR(world->Read(i).position.y() - below, 1, 0.00025 * count) << count << ' ' << i;
      EXPECT_NEAR(world->Read(i).position.x(), 0, 0.001 * count) << count << ' ' << i;
    }
  }
}

/// By the parabola, not by the sum of steps.
TEST(SoftAnswers, AThrownThingFollowsTheParabola) {
  const auto world = SoftWorld(Thing("circle = 0.5", 0, 100, "velocity = [7, 12]"));
  for (int tick = 1; tick <= 240; ++tick) {
    world->Step();
    const double t = tick / 60.0;
    EXPECT_NEAR(world->Read(0).position.x(), 7 * t, 1e-3);
    EXPECT_NEAR(world->Read(0).position.y(), 100 + 12 * t - 5 * t * t, 1e-3);
  }
}

TEST(SoftAnswers, AHeapComesToRest) {
  for (const char* shape : {"box = [0.5, 0.5]", "circle = 0.25"}) {
    std::string parts =
        "[[part]]\nname = \"pit\"\nchain = [[-3, 40], [-3, 0], [3, 0], [3, 40]]\n"
        "friction = 0.6\n";
    for (int row = 0; row < 10; ++row) {
      parts += "[[part]]\nname = \"row" + std::to_string(row) + "\"\n" + shape + "\nposition = [" +
               FloatDigits(-2.5 + row % 2 * 0.13) + ", " + FloatDigits(0.5 + 0.7 * row) +
               "]\nfriction = 0.6\nrepeat = {count = 7, step = [0.7, 0]}\n";
    }
    const auto world = SoftWorld(parts);
    Steps(world.get(), 1200);
    double sum = 0;
    for (int body = 0; body < world->body_count(); ++body) {
      sum += static_cast<double>(world->Read(body).velocity.squaredNorm());
      EXPECT_GT(world->Read(body).position.y(), 0.2f);
    }
    EXPECT_LT(std::sqrt(sum / world->body_count()), 0.01) << shape;
  }
}

}  // namespace soft_answers_test
}  // namespace seam
