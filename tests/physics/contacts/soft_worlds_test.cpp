/// Soft contacts in whole worlds: replays, sleep, and beside joints, stages and listeners.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/allocations/count_allocations.h"
#include "tests/support/scripted_world.h"
#include "tests/support/small_world.h"

namespace seam {
namespace soft_worlds_test {

constexpr const char* kSoft = "contacts = \"soft\"\n";
constexpr const char* kGround =
    "[[part]]\nname = \"ground\"\nchain = [[-50, 0], [50, 0]]\nfriction = 0.6\n";

Scene SoftScene(const std::string& name) {
  Scene scene = LoadScene("scenes/" + name + ".toml");
  scene.solver.contacts = ContactSolving::kSoft;
  scene.solver.skin = 0.0025f;
  return scene;
}

std::vector<std::uint64_t> Hashes(const std::string& name, int ticks) {
  ScriptedWorld run(SoftScene(name));
  std::vector<std::uint64_t> hashes;
  for (int t = 0; t < ticks; ++t) {
    run.Step();
    hashes.push_back(run.world.Hash());
  }
  return hashes;
}

constexpr const char* kScenes[] = {"stack", "wall", "heap", "crossing", "gas", "seesaw"};

TEST(SoftWorlds, TheSameRunTwiceGivesTheSameBits) {
  for (const char* scene : kScenes) EXPECT_EQ(Hashes(scene, 300), Hashes(scene, 300)) << scene;
}

TEST(SoftWorlds, ASceneWithSoftContactsIsAnotherOne) {
  ScriptedWorld engine("stack");
  engine.StepTo(60);
  EXPECT_NE(engine.world.Hash(), Hashes("stack", 60).back());
}

/// Goes back from each third barrier and steps again.
TEST(SoftWorlds, ReplayFromABarrierIsBitExact) {
  constexpr int kTicks = 150, kEvery = 3, kBack = 10;
  for (const char* scene : kScenes) {
    World world(SoftScene(scene));
    std::vector<std::uint64_t> hashes = {world.Hash()};
    std::vector<WorldSnapshot> barriers;
    for (int t = 1; t <= kTicks; ++t) {
      world.Step();
      if (t % kEvery == 0) barriers.push_back(world.Barrier());
      hashes.push_back(world.Hash());
    }
    for (std::size_t b = 0; b < barriers.size(); b += 3) {
      ASSERT_TRUE(world.Restore(barriers[b]).ok());
      for (int i = 1; i <= kBack && world.tick() < kTicks; ++i) {
        world.Step();
        if (world.tick() % kEvery == 0) world.Barrier();
        ASSERT_EQ(world.Hash(), hashes[static_cast<std::size_t>(world.tick())]) << scene;
      }
    }
  }
}

std::string Pile(int count) {
  return std::string(kGround) + "[[part]]\nname = \"box\"\nbox = [1, 1]\nposition = [0, 0.5]\n" +
         "friction = 0.6\nrepeat = {count = " + std::to_string(count) + ", step = [0, 1]}\n";
}

TEST(SoftWorlds, APileFallsAsleepAndWakesWhenItIsStruck) {
  World world(ParseScene(std::string("[solver]\n") + kSoft + Pile(5) +
                             "[[part]]\nname = \"ball\"\ncircle = 0.3\nposition = [-12, 2.5]\n"
                             "velocity = [0, 60]\n",
                         "pile.toml"));
  Steps(&world, 240);
  for (int body = 0; body < 5; ++body) EXPECT_FALSE(world.awake(body)) << body;
  BodyState ball = world.Read(5);
  ball.position = Vec2(-2, 2.5f);
  ball.velocity = Vec2(12, 0);
  world.Write(5, ball);
  Steps(&world, 20);
  for (int body = 0; body < 5; ++body) EXPECT_TRUE(world.awake(body)) << body;
}

/// Onto a box on the ground, which does not give way.
TEST(SoftWorlds, ImpactsReportTheMomentumOfAFall) {
  const auto world = SmallWorld(std::string(kGround) +
                                    "[[part]]\nname = \"a\"\nbox = [1, 1]\nposition = [0, 0.5]\n"
                                    "[[part]]\nname = \"b\"\nbox = [1, 1]\nposition = [0, 2.7]\n",
                                kSoft, "gravity = [0, -10]");
  double most = 0;
  for (int t = 0; t < 90; ++t) {
    world->Step();
    for (const Impact& impact : world->impacts()) {
      if (impact.body_a == 0 && impact.body_b == 1) {
        most = std::max(most, static_cast<double>(impact.dv));
      }
    }
  }
  EXPECT_NEAR(most, std::sqrt(2 * 10 * 1.2), 0.5);
}

TEST(SoftWorlds, AnIslandWithAJointRestsBesideOthersAsDeep) {
  const auto world =
      SmallWorld(Pile(3) +
                     "[[part]]\nname = \"left\"\nbox = [1, 1]\nposition = [5, 0.5]\n"
                     "[[part]]\nname = \"right\"\nbox = [1, 1]\nposition = [7, 0.5]\n"
                     "[[part]]\nname = \"lid\"\nbox = [1, 1]\nposition = [5, 1.5]\n"
                     "[[joint]]\nname = \"j\"\nkind = \"hinge\"\na = \"left\"\nb = \"right\"\n"
                     "anchor = [6, 0.5]\n",
                 kSoft);
  Steps(world.get(), 240);
  const std::vector<float> right = {0.5f, 1.5f, 2.5f, 0.5f, 0.5f, 1.5f};
  for (int body = 0; body < 6; ++body) {
    EXPECT_NEAR(world->Read(body).position.y(), right[static_cast<std::size_t>(body)], 0.006)
        << body;
  }
}

/// Loads of 10 to 1000 times the mass of each of three boxes.
TEST(SoftWorlds, AHeavyLoadStandsOnLightBoxes) {
  for (const double heavy : {10.0, 100.0, 400.0, 1000.0}) {
    const auto world = SmallWorld(
        std::string(kGround) +
            "[[part]]\nname = \"light\"\nbox = [1, 1]\nposition = [0, 0.5]\nfriction = 0.6\n"
            "density = 0.1\nrepeat = {count = 3, step = [0, 1]}\n"
            "[[part]]\nname = \"load\"\nbox = [1, 1]\nposition = [0, 3.5]\nfriction = 0.6\n"
            "density = " +
            FloatDigits(heavy / 10) + "\n",
        kSoft, "gravity = [0, -10]");
    Steps(world.get(), 1200);
    for (int body = 0; body < 4; ++body) {
      EXPECT_NEAR(world->Read(body).position.y(), 0.5f + static_cast<float>(body), 0.01) << heavy;
      EXPECT_NEAR(world->Read(body).position.x(), 0, 0.01) << heavy;
    }
  }
}

/// A kinematic room turns around boxes that lie in it: none gets out, and none passes its walls.
TEST(SoftWorlds, ATurningRoomKeepsItsBoxes) {
  std::string parts;
  const char* const walls[] = {
      "box = [1, 10]\nposition = [5, 5]", "box = [1, 10]\nposition = [-5, 5]",
      "box = [10, 1]\nposition = [0, 10]", "box = [10, 1]\nposition = [0, 0]"};
  for (int i = 0; i < 4; ++i) {
    const std::string name = "wall" + std::to_string(i);
    parts += "[[part]]\nname = \"" + name + "\"\n" + walls[i] + "\nanchored = true\n";
    if (i > 0) {
      parts += "[[joint]]\nname = \"join" + name + "\"\nkind = \"weld\"\na = \"wall0\"\nb = \"" +
               name + "\"\n";
    }
  }
  parts +=
      "[[joint]]\nname = \"turn\"\nkind = \"kinematic\"\nb = \"wall0\"\nanchor = [0, 5]\n"
      "turning = 2\n";
  for (int row = 0; row < 8; ++row) {
    parts += "[[part]]\nname = \"row" + std::to_string(row) +
             "\"\nbox = [0.4, 0.4]\nposition = [-2, " + FloatDigits(2.5 + 0.6 * row) +
             "]\nrepeat = {count = 7, step = [0.6, 0]}\n";
  }
  const auto world = SmallWorld(parts, kSoft, "gravity = [0, -10]");
  Steps(world.get(), 600);
  for (int body = 0; body < world->body_count(); ++body) {
    EXPECT_LT((world->Read(body).position - Vec2(0, 5)).norm(), 6.7f) << body;
  }
}

/// Past many resting boxes, so that its contacts are few among many.
TEST(SoftWorlds, ABulletStopsAtAWallBesideAPile) {
  const auto world = SmallWorld(
      Pile(12) +
          "[[part]]\nname = \"wall\"\nbox = [0.1, 8]\nposition = [20, 4]\nanchored = true\n" +
          "[[part]]\nname = \"shot\"\ncircle = 0.1\nbullet = true\nposition = [3, 4]\n"
          "velocity = [100, 0]\n",
      kSoft, "gravity = [0, -10]");
  Steps(world.get(), 60);
  EXPECT_LT(world->Read(12).position.x(), 20);
  EXPECT_NEAR(world->Read(11).position.y(), 11.5, 0.02);
}

TEST(SoftWorlds, AConveyorCarriesWhatStandsOnIt) {
  const auto world = SmallWorld(
      "[[part]]\nname = \"band\"\nbox = [40, 1]\nposition = [0, -0.5]\nanchored = true\n"
      "friction = 0.8\nconveyor = 2\n"
      "[[part]]\nname = \"box\"\nbox = [1, 1]\nposition = [0, 0.5]\nfriction = 0.8\n",
      kSoft, "gravity = [0, -10]");
  Steps(world.get(), 120);
  EXPECT_NEAR(std::fabs(world->Read(0).velocity.x()), 2, 1e-3);
}

TEST(SoftWorlds, NothingFastPassesThroughAThinFloor) {
  for (const float speed : {20.0f, 60.0f, 110.0f}) {
    const auto world = SmallWorld(
        "[[part]]\nname = \"floor\"\nbox = [80, 0.05]\nposition = [0, -0.025]\nanchored = true\n"
        "[[part]]\nname = \"shot\"\nbox = [0.3, 0.3]\nposition = [0, 30]\nvelocity = [3, " +
            FloatDigits(-static_cast<double>(speed)) + "]\n",
        kSoft);
    Steps(world.get(), 120);
    EXPECT_GT(world->Read(0).position.y(), 0) << speed;
  }
}

TEST(SoftWorlds, AStepAllocatesNoMoreThanTheEngines) {
  std::size_t used[2] = {};
  for (const bool soft : {false, true}) {
    const auto world = SmallWorld(Pile(12), soft ? kSoft : "");
    Steps(world.get(), 120);
    const std::size_t before = AllocatedBytes();
    Steps(world.get(), 120);
    used[soft ? 1 : 0] = AllocatedBytes() - before;
  }
  EXPECT_LE(used[1], used[0]);
}

}  // namespace soft_worlds_test
}  // namespace seam
