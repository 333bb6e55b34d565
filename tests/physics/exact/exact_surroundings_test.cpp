/// Mechanisms moved by platforms, belts, water and walls; and the impacts that are reported.

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/physics/exact/exact_scenes.h"

namespace seam {
namespace exact_surroundings_test {

/// Two planks of 1 m, hinged, flat on a surface at height `y`.
std::string Planks(double y) {
  return PartText("plank", "box = [1, 0.3]\nposition = [0, " + FloatDigits(y + 0.165) +
                               "]\nfriction = 0.8\nrepeat = {count = 2, step = [1, 0]}") +
         HingeText("h", "plank.0", "plank.1", 0.5, y + 0.165);
}

TEST(ExactSurroundings, AMovingPlatformCarriesJointedPlanks) {
  const auto world = ExactWorld(
      "[[part]]\nname = \"platform\"\nbox = [6, 0.5]\nposition = [0, 1.75]\nanchored = true\n"
      "friction = 0.8\n"
      "[[joint]]\nname = \"mover\"\nkind = \"kinematic\"\nb = \"platform\"\n"
      "path = [[0, 0], [40, 0]]\nperiod = 40\n" +
      Planks(2));
  Steps(world.get(), 120);
  const std::vector<BodyState> before = StatesOf(*world);
  EXPECT_NEAR(before[0].velocity.x(), 2, 1e-3);
  Steps(world.get(), 60);
  for (int body = 0; body < 2; ++body) {
    const BodyState now = world->Read(body);
    EXPECT_NEAR(now.position.x() - before[static_cast<std::size_t>(body)].position.x(), 2, 2e-3);
    EXPECT_NEAR(now.position.y(), 2.165, 6e-3);
  }
  EXPECT_LT(Drift(*world), 1e-5);
}

TEST(ExactSurroundings, APlatformThatMovesAgainWakesItsSleepers) {
  Scene scene = ParseScene(
      std::string("[solver]\n") + kExactJoints +
          "[[part]]\nname = \"platform\"\nbox = [6, 0.5]\nposition = [0, 1.75]\nanchored = true\n"
          "[[joint]]\nname = \"mover\"\nkind = \"kinematic\"\nb = \"platform\"\n"
          "path = [[0, 0], [0, 2]]\nperiod = 8\nease = true\n" +
          Planks(2),
      "s.toml");
  World world(scene);
  Steps(&world, 240);
  EXPECT_NEAR(world.Read(0).position.y(), 4.165, 0.02);
  Steps(&world, 240);
  EXPECT_NEAR(world.Read(0).position.y(), 2.165, 0.02);
}

TEST(ExactSurroundings, AHingeOnAPlatformGoesWithIt) {
  const auto world = ExactWorld(
      "[[part]]\nname = \"platform\"\nbox = [1, 0.5]\nposition = [0, 5]\nanchored = true\n"
      "[[joint]]\nname = \"mover\"\nkind = \"kinematic\"\nb = \"platform\"\n"
      "path = [[0, 0], [12, 0], [12, 3]]\nperiod = 6\n" +
      PartText("rod", "box = [0.1, 2]\nposition = [0, 3.5]") +
      HingeText("h", "platform", "rod", 0, 4.5));
  for (int t = 0; t < 600; ++t) {
    world->Step();
    ASSERT_LT(Drift(*world), 2e-3) << "tick " << t;
  }
}

TEST(ExactSurroundings, AConveyorDragsWithMuGUntilEverythingMovesWithIt) {
  const auto world = ExactWorld(
      "[[part]]\nname = \"belt\"\nbox = [60, 1]\nposition = [0, -0.5]\nfriction = 0.2\n"
      "conveyor = 3\nanchored = true\n" +
      Planks(0));
  // mu = sqrt(0.2 * 0.8) = 0.4: 4 m/s2.
  Steps(world.get(), 10);
  const float before = world->Read(0).velocity.x();
  Steps(world.get(), 30);
  EXPECT_NEAR(world->Read(0).velocity.x() - before, 2, 0.05);
  Steps(world.get(), 60);
  EXPECT_NEAR(world->Read(0).velocity.x(), 3, 0.02);
  EXPECT_NEAR(world->Read(1).velocity.x(), 3, 0.02);
  EXPECT_LT(Drift(*world), 1e-5);
}

TEST(ExactSurroundings, WaterBearsARaftOfPlanks) {
  // Half as dense as water: it swims with its middle in the surface.
  const auto world = ExactWorld("[[water]]\nname = \"pool\"\nbox = [40, 10]\nposition = [0, -5]\n" +
                                PartText("plank",
                                         "box = [1, 0.4]\nposition = [0, 0.3]\ndensity = 500e-3\n"
                                         "repeat = {count = 3, step = [1, 0]}") +
                                HingeText("h0", "plank.0", "plank.1", 0.5, 0.3) +
                                HingeText("h1", "plank.1", "plank.2", 1.5, 0.3));
  Steps(world.get(), 1200);
  for (int body = 0; body < 3; ++body) {
    EXPECT_LT(world->Read(body).position.y(), 0.2) << body;
    EXPECT_GT(world->Read(body).position.y(), -0.4) << body;
    EXPECT_NEAR(world->Read(body).angle, 0, 0.05) << body;
  }
  EXPECT_LT(Drift(*world), 1e-5);
}

/// Throws a chain at a wall of 10 cm at x = 10 from several sides. The farthest right that a
/// link's middle came, and the worst drift.
struct Thrown {
  float farthest = -1000;
  double drift = 0;
};

Thrown Throw(double tilt, float speed, const char* solver) {
  const auto world = ExactWorld(
      "[[part]]\nname = \"wall\"\nbox = [0.1, 40]\nposition = [10, 0]\nanchored = true\n" +
          ChainText(6, -3, 0, "friction = 0.4"),
      solver, "gravity = [0, 0]\n");
  const double c = std::cos(tilt), s = std::sin(tilt);
  for (int body = 0; body < world->body_count(); ++body) {
    BodyState state = world->Read(body);
    const auto x = static_cast<double>(state.position.x());
    state.position = {static_cast<float>(c * x), static_cast<float>(s * x)};
    state.angle = static_cast<float>(tilt);
    state.velocity = {speed, 0};
    world->Write(body, state);
  }
  Thrown out;
  for (int t = 0; t < 90; ++t) {
    world->Step();
    out.drift = std::max(out.drift, Drift(*world));
    for (int body = 0; body < world->body_count(); ++body) {
      out.farthest = std::max(out.farthest, world->Read(body).position.x());
    }
  }
  return out;
}

TEST(ExactSurroundings, AThrownChainRarelyPassesAThinWallAndStaysClosed) {
  int thrown_all = 0, passed = 0;
  for (const char* solver : {"", "joint_substeps = 1\n", "joint_substeps = 3\n"}) {
    for (int i = 0; i < 32; ++i) {
      const Thrown thrown = Throw(0.05 * i, 60, solver);
      ++thrown_all;
      passed += thrown.farthest >= 10 ? 1 : 0;
      EXPECT_GT(thrown.farthest, 9) << "it reached the wall; " << 0.05 * i;
      EXPECT_LT(thrown.drift, 1e-4) << 0.05 * i << " rad " << solver;
    }
  }
  // A link's middle got into the wall in 17 of 474 throws with steps of 0.01 rad.
  EXPECT_LE(passed, thrown_all / 16);
}

/// Impacts of each body in `ticks`.
std::map<int, std::vector<float>> Blows(World* world, int ticks) {
  std::map<int, std::vector<float>> blows;
  for (int t = 0; t < ticks; ++t) {
    world->Step();
    for (const Impact& impact : world->impacts()) {
      blows[std::max(impact.body_a, impact.body_b)].push_back(impact.dv);
    }
  }
  return blows;
}

TEST(ExactSurroundings, AnImpactIsReportedOncePerBodyWithItsChangeOfSpeed) {
  // Flat on the ground from 1 m: 4.47 m/s, no rebound.
  const auto world = ExactWorld(kGround + Planks(1.0));
  const auto blows = Blows(world.get(), 120);
  ASSERT_EQ(blows.size(), 2u);
  double sum = 0;  // how the two share it is not determined: the hinge passes some of it on
  for (const auto& [body, dv] : blows) {
    ASSERT_EQ(dv.size(), 1u) << "body " << body;
    sum += double{dv[0]};
  }
  EXPECT_NEAR(sum / 2, std::sqrt(2 * 10 * 1.0), 0.35);
}

TEST(ExactSurroundings, AnElasticImpactOnAMechanismIsReportedToo) {
  const auto world = ExactWorld(
      PartText("plank", "box = [1, 0.3]\nposition = [0, 0]\nrepeat = {count = 2, step = [1, 0]}") +
          HingeText("h", "plank.0", "plank.1", 0.5, 0) +
          PartText("ball", "circle = 0.3\nposition = [-4, 0]\nvelocity = [9, 0]\nrestitution = 1"),
      "", "gravity = [0, 0]\n");
  const auto blows = Blows(world.get(), 60);
  int met = 0;
  for (const auto& [body, dv] : blows) met += static_cast<int>(dv.size());
  EXPECT_EQ(met, 1);
  // The planks are one mass along their line: 0.6 kg against 0.2827 kg.
  const double m = 0.09 * 3.14159265, planks = 0.6;
  EXPECT_NEAR(world->Read(2).velocity.x(), 9 * (m - planks) / (m + planks), 0.02);
  EXPECT_NEAR(world->Read(0).velocity.x(), 9 * 2 * m / (m + planks), 0.02);
}

}  // namespace exact_surroundings_test
}  // namespace seam
