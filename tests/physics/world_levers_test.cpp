/// The other settings of `[solver]`, each with the cost of a wrong value.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "common/physics/world.h"

namespace seam {
namespace world_levers_test {

std::unique_ptr<World> Levers(const std::string& solver, const std::string& parts) {
  return std::make_unique<World>(
      ParseScene("[solver]\nsleep = false\n" + solver + "\n" + parts, "s.toml"));
}

const char* kShot =
    "[[part]]\nname = \"wall\"\nbox = [0.05, 4]\nanchored = true\n"
    "[[part]]\nname = \"shot\"\ncircle = 0.1\nposition = [-5.5, 0]\nvelocity = [60, 0]\n";

float ShotAfter(const std::string& solver) {
  World world(ParseScene("gravity = [0, 0]\n[solver]\n" + solver + "\n" + kShot, "s.toml"));
  for (int i = 0; i < 30; ++i) world.Step();
  return world.Read(0).position.x();
}

TEST(SolverSettings, ContinuousCollisionStopsAShotThatWithoutItPassesAThinWall) {
  EXPECT_LT(ShotAfter("continuous = true"), 0);
  EXPECT_GT(ShotAfter("continuous = false"), 10);
}

TEST(SolverSettings, SubstepsRaiseTheEnginesSpeedLimitOfTwoMetresAStep) {
  for (const int substeps : {1, 2, 4}) {
    Scene scene = ParseScene(std::string("gravity = [0, 0]\n") + kShot, "s.toml");
    scene.solver.substeps = substeps;
    scene.parts[1].velocity = Vec2(-300, 0);  // away from the wall
    World world(scene);
    world.Step();
    const float limit = std::min(300.0f, 120.0f * static_cast<float>(substeps));
    EXPECT_NEAR(world.Read(0).velocity.x(), -limit, 0.01f);
  }
}

TEST(SolverSettings, FreeBodiesKeepTheirSpeedAndSpinAtAnyTickRate) {
  for (const int tick_hz : {10, 15, 20, 30, 50, 59, 60, 120}) {
    const auto world = Levers("tick_hz = " + std::to_string(tick_hz),
                              "[[part]]\nname = \"flies\"\ncircle = 0.5\nposition = [0, 500]\n"
                              "velocity = [15, 0]\nspin = 60\n"
                              "[[part]]\nname = \"turns\"\nbox = [1, 2]\nposition = [9, 500]\n"
                              "velocity = [100, 60]\nspin = -93\n");
    for (int i = 0; i < 5 * tick_hz; ++i) world->Step();
    EXPECT_NEAR(world->Read(0).velocity.x(), 15, 1e-3) << tick_hz;
    EXPECT_NEAR(world->Read(0).velocity.y(), -50, 1e-3) << tick_hz;
    EXPECT_NEAR(world->Read(0).spin, 60, 1e-3) << tick_hz;
    EXPECT_NEAR(world->Read(1).velocity.x(), 100, 1e-2) << tick_hz;
    EXPECT_NEAR(world->Read(1).velocity.y(), 10, 1e-2) << tick_hz;
    EXPECT_NEAR(world->Read(1).spin, -93, 1e-2) << tick_hz;
  }
}

TEST(SolverSettings, TheLoaderRaisesSubstepsToSixtyStepsASecond) {
  const auto substeps = [](const std::string& solver) {
    return ParseScene(kShot + ("[solver]\n" + solver), "s.toml").solver.substeps;
  };
  EXPECT_EQ(substeps("tick_hz = 10"), 6);
  EXPECT_EQ(substeps("tick_hz = 20\nsubsteps = 2"), 3);
  EXPECT_EQ(substeps("tick_hz = 20\nsubsteps = 4"), 4);
  EXPECT_EQ(substeps("tick_hz = 59"), 2);
  EXPECT_EQ(substeps("tick_hz = 60"), 1);
  EXPECT_EQ(substeps("tick_hz = 240"), 1);
}

TEST(SolverSettings, WeldsAsIterativeJointsBendWhereOneBodyDoesNot) {
  const std::string beam =
      "[[part]]\nname = \"wall\"\nbox = [1, 1]\nposition = [-0.5, 0]\nanchored = true\n"
      "[[part]]\nname = \"link\"\nbox = [1, 0.2]\nposition = [0.5, 0]\ngroup = -1\n"
      "repeat = {count = 5, step = [1, 0]}\n"
      "[[joint]]\nname = \"j\"\nkind = \"weld\"\na = \"link.0\"\nb = \"link.1\"\nanchor = [1, 0]\n"
      "repeat = {count = 4, step = [1, 0]}\n"
      "[[joint]]\nname = \"root\"\nkind = \"revolute\"\na = \"wall\"\nb = \"link.0\"\n"
      "anchor = [0, 0]\nlimits = [0, 0]\n";
  World one(ParseScene(beam, "s.toml"));
  EXPECT_EQ(one.body_count(), 1);
  World joints(
      ParseScene("[solver]\nwelds = \"joint\"\njoints = \"iterative\"\n" + beam, "s.toml"));
  ASSERT_EQ(joints.body_count(), 5);
  World exact(ParseScene("[solver]\nwelds = \"joint\"\n" + beam, "s.toml"));
  for (int i = 0; i < 120; ++i) {
    joints.Step();
    exact.Step();
  }
  EXPECT_LT(joints.Read(4).position.y(), -0.05f);
  EXPECT_NEAR(exact.Read(4).position.y(), 0, 1e-6) << "solved as one system they do not bend";
}

TEST(SolverSettings, WithoutWarmStartingAStackIsSofter) {
  float sunk[2];
  for (const bool warm : {false, true}) {
    std::string parts = "[[part]]\nname = \"ground\"\nchain = [[-9, 0], [9, 0]]\n";
    for (int i = 0; i < 8; ++i) {
      parts += "[[part]]\nname = \"box" + std::to_string(i) + "\"\nbox = [1, 1]\nposition = [0, " +
               std::to_string(0.515 + 1.015 * i) + "]\n";
    }
    const auto world = Levers(std::string("warm_starting = ") + (warm ? "true" : "false"), parts);
    for (int i = 0; i < 120; ++i) world->Step();
    sunk[warm] = 0.515f + 1.015f * 7 - world->Read(7).position.y();
  }
  EXPECT_GT(sunk[false], sunk[true] + 0.01f);
}

}  // namespace world_levers_test
}  // namespace seam
