/// Damping, gravity scale, fixed rotation, collision filters, prismatic springs and moving lines,
/// each against its equation.

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/check.h"
#include "common/base/geometry.h"
#include "common/topology/topology.h"
#include "tests/support/small_world.h"

namespace seam {
namespace part_motion_test {

const char* kWeightless = "gravity = [0, 0]\n";
constexpr int kHz = 60;

std::string PartOf(const std::string& name, const std::string& rest) {
  return "[[part]]\nname = \"" + name + "\"\n" + rest + "\n";
}

/// The error of a scene's text; "" if it loads.
std::string ErrorOf(const std::string& text) {
  try {
    ParseScene(text, "t.toml");
  } catch (const OperatorError& e) {
    return e.what();
  }
  return "";
}

TEST(PartMotion, DampingDividesTheSpeedsInEachStep) {
  for (const double damping : {0.5, 3.0, 40.0}) {
    const auto world = SmallWorld(PartOf("disc",
                                         "circle = 1\nvelocity = [6, -2]\nspin = 5\n"
                                         "linear_damping = " +
                                             std::to_string(damping) + "\nangular_damping = 2"),
                                  "", kWeightless);
    Steps(world.get(), 30);
    const double left = std::pow(1 + damping / kHz, -30), turns = std::pow(1 + 2.0 / kHz, -30);
    EXPECT_NEAR(world->Read(0).velocity.x(), 6 * left, 1e-4) << damping;
    EXPECT_NEAR(world->Read(0).velocity.y(), -2 * left, 1e-4) << damping;
    EXPECT_NEAR(world->Read(0).spin, 5 * turns, 1e-4) << damping;
  }
}

TEST(PartMotion, GravityScaleMultipliesGravity) {
  for (const double scale : {-1.0, 0.0, 0.25, 2.0}) {
    const auto world = SmallWorld(PartOf(
        "disc", "circle = 1\nangular_damping = 0\ngravity_scale = " + std::to_string(scale)));
    Steps(world.get(), kHz);
    EXPECT_NEAR(world->Read(0).velocity.y(), -10 * scale, 1e-4) << scale;
  }
}

TEST(PartMotion, WeldedPartsHaveTheMeanByMass) {
  // 1 kg that floats and 3 kg that fall: 3/4 of gravity.
  const auto world = SmallWorld(PartOf("light", "box = [1, 1]\ngravity_scale = 0") +
                                PartOf("heavy", "box = [1, 1]\ndensity = 3\nposition = [1, 0]") +
                                "[[joint]]\nname = \"w\"\nkind = \"weld\"\na = \"light\"\n"
                                "b = \"heavy\"\n");
  Steps(world.get(), kHz);
  EXPECT_NEAR(world->Read(0).velocity.y(), -7.5, 1e-4);
}

TEST(PartMotion, FixedRotationNeverTurns) {
  // A blow off the centre, and a hinge at the end of a rod.
  const auto world = SmallWorld(
      PartOf("target", "box = [1, 2]\nfixed_rotation = true\nangle = 0.3") +
          PartOf("shot", "circle = 0.2\ndensity = 5\nposition = [-3, 0.8]\nvelocity = [20, 0]") +
          PartOf("post", "box = [0.2, 0.2]\nposition = [0, 9]\nanchored = true") +
          PartOf("rod", "box = [2, 0.2]\nposition = [1, 9]\nfixed_rotation = true") +
          "[[joint]]\nname = \"h\"\nkind = \"hinge\"\na = \"post\"\nb = \"rod\"\nanchor = [0, 9]\n",
      "", "");
  for (int tick = 0; tick < 60; ++tick) {
    Steps(world.get(), 1);
    EXPECT_FLOAT_EQ(world->Read(0).angle, 0.3f);
    EXPECT_LT(std::abs(world->Read(0).spin), 1e-12);
    EXPECT_LT((world->Read(2).position - Vec2(1, 9)).norm(), 1e-3);
  }
  EXPECT_GT(world->Read(0).velocity.x(), 1) << "the shot has hit";
}

TEST(PartMotion, FiltersDecideWhatCollides) {
  const std::string floor = PartOf("floor",
                                   "box = [20, 1]\nposition = [0, -2]\nanchored = true\n"
                                   "category = 2\nmask = 6");
  const auto rests = [&](const std::string& keys) {
    const auto world = SmallWorld(floor + PartOf("ball", "circle = 0.5\n" + keys));
    Steps(world.get(), 2 * kHz);
    return world->Read(0).position.y() > -1.6f;
  };
  EXPECT_TRUE(rests("category = 4\nmask = 2"));
  EXPECT_FALSE(rests("category = 1\nmask = 2")) << "the floor's mask has no 1";
  EXPECT_FALSE(rests("category = 4\nmask = 4")) << "the ball's mask has no 2";
  EXPECT_TRUE(rests("category = 6\nmask = 65535"));
}

TEST(PartMotion, APrismaticSpringSwingsAtItsFrequency) {
  // Box2D takes the stiffness from the reduced mass: between a post and a load that of the load.
  for (const char* solving : {"iterative", "exact"}) {
    const auto world =
        SmallWorld(PartOf("post", "box = [0.2, 0.2]\nanchored = true") +
                       PartOf("load", "box = [1, 1]\nvelocity = [2, 0]") +
                       "[[joint]]\nname = \"j\"\nkind = \"prismatic\"\na = \"post\"\n"
                       "b = \"load\"\nfrequency = 1\ndamping_ratio = 0\n",
                   "tick_hz = 240\njoints = \"" + std::string(solving) + "\"\n", kWeightless);
    double most = 0;
    for (int tick = 1; tick <= 240; ++tick) {
      Steps(world.get(), 1);
      most = std::max(most, static_cast<double>(world->Read(0).position.x()));
      EXPECT_NEAR(world->Read(0).position.y(), 0, 1e-3);
    }
    // x = v / omega sin(omega t); the implicit spring of the engine damps a little.
    EXPECT_NEAR(most, 2 / (2 * kPi), 0.01) << solving;
    EXPECT_NEAR(world->Read(0).position.x(), 0, 0.02) << solving;
    EXPECT_GT(world->Read(0).velocity.x(), 1.8) << solving;
  }
}

TEST(PartMotion, ARemovedSlideTakesItsSpringAlong) {
  const auto world =
      SmallWorld(PartOf("post", "box = [0.2, 0.2]\nanchored = true") +
                     PartOf("load", "box = [1, 1]\nposition = [1, 0]\nvelocity = [2, 0]") +
                     "[[joint]]\nname = \"j\"\nkind = \"prismatic\"\na = \"post\"\nb = \"load\"\n"
                     "frequency = 2\n",
                 "", kWeightless);
  ASSERT_EQ(world->scene().joints.size(), 2u);
  EXPECT_EQ(world->scene().joints[1].name, "j.spring");
  ASSERT_TRUE(world->Apply({Edit(BreakEdit{0})}).has_value());
  EXPECT_TRUE(world->scene().joints[1].gone);
  Steps(world.get(), 30);
  EXPECT_NEAR(world->Read(0).velocity.x(), 2, 1e-5);
}

/// A pan of a chain: a flat bottom between two walls, carried by a box below.
TEST(PartMotion, AChainOnAMovingBodyCarriesWhatLiesInIt) {
  const auto world = SmallWorld(
      PartOf("cart",
             "box = [3, 0.4]\nvelocity = [1, 0]\ngravity_scale = 0\nfixed_rotation = true\n"
             "density = 50") +
          PartOf("pan",
                 "chain = [[-1.4, 1], [-1.2, 0], [1.2, 0], [1.4, 1]]\nposition = [0, 0.5]\n"
                 "anchored = false\nvelocity = [1, 0]\ngravity_scale = 0") +
          PartOf("ball", "circle = 0.3\nposition = [0, 1.2]\nvelocity = [1, 0]") +
          "[[joint]]\nname = \"w\"\nkind = \"weld\"\na = \"cart\"\nb = \"pan\"\n",
      "", "");
  Steps(world.get(), 3 * kHz);
  const Vec2 cart = world->Read(0).position, ball = world->Read(1).position;
  EXPECT_NEAR(cart.x(), 3, 0.1);
  EXPECT_LT(std::abs(ball.x() - cart.x()), 1.2f);
  EXPECT_NEAR(ball.y() - cart.y(), 0.8, 0.03);
}

TEST(PartMotion, MistakesAreNamed) {
  const std::string box = "[[part]]\nname = \"a\"\nbox = [1, 1]\n";
  EXPECT_NE(ErrorOf(box + "mask = 65536\n").find("mask"), std::string::npos);
  EXPECT_NE(ErrorOf(box + "linear_damping = -1\n").find("linear_damping"), std::string::npos);
  EXPECT_NE(ErrorOf(box + "fixed_rotation = true\nspin = 1\n").find("fixed_rotation"),
            std::string::npos);
  EXPECT_NE(ErrorOf(box + "anchored = true\ngravity_scale = 0\n").find("gravity_scale"),
            std::string::npos);
  EXPECT_NE(ErrorOf("size_max = 1000\n[[part]]\nname = \"far\"\nanchored = false\n"
                    "chain = [[900, 900], [900.1, 900]]\n")
                .find("too far from its position"),
            std::string::npos);
}

}  // namespace part_motion_test
}  // namespace seam
