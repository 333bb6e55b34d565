/// Conveyors and thrust against their equations.

#include "common/scene/forces.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/small_world.h"

namespace seam {
namespace forces_test {

const char* kAnn = "[[player]]\nname = \"ann\"\n";

std::string Belt(const std::string& speed, const std::string& rest = "anchored = true") {
  return "[[part]]\nname = \"belt\"\nbox = [40, 1]\nposition = [0, -0.5]\nfriction = 0.4\n"
         "conveyor = " +
         speed + "\n" + rest + "\n";
}
std::string Crate(const std::string& rest = "") {
  return "[[part]]\nname = \"crate\"\nbox = [1, 1]\nposition = [0, 0.515]\nfriction = 0.4\n" +
         rest + "\n";
}
Input Of(int drive, int lift, int buttons = 0) {
  return {static_cast<std::int8_t>(drive), static_cast<std::int8_t>(lift),
          static_cast<std::int16_t>(buttons)};
}

TEST(Conveyor, DragsWithMuGUntilItsLoadMovesWithIt) {
  // mu = sqrt(0.4 0.4) = 0.4: 4 m/s^2 to 3 m/s, in 45 ticks.
  for (const char* order : {"belt first", "crate first"}) {
    const bool first = order[0] == 'b';
    const auto world = SmallWorld(first ? Belt("3") + Crate() : Crate() + Belt("3"));
    Steps(world.get(), 10);
    const float before = world->Read(0).velocity.x();
    Steps(world.get(), 30);
    EXPECT_NEAR(world->Read(0).velocity.x() - before, 0.4 * 10 * 0.5, 0.05) << order;
    Steps(world.get(), 60);
    EXPECT_NEAR(world->Read(0).velocity.x(), 3, 0.02) << order;
    EXPECT_NEAR(world->Read(0).spin, 0, 0.02) << order;
  }
}

TEST(Conveyor, RunsClockwiseAround) {
  // A load on a rope, pressed against the underside, is dragged to the left.
  const auto world = SmallWorld(
      "[[part]]\nname = \"belt\"\nbox = [40, 1]\nposition = [0, 0]\nconveyor = 2\n"
      "anchored = true\n"
      "[[part]]\nname = \"balloon\"\nbox = [1, 1]\nposition = [0, -1.02]\n",
      "", "gravity = [0, 10]\n");
  Steps(world.get(), 120);
  EXPECT_NEAR(world->Read(0).velocity.x(), -2, 0.02);
}

TEST(Conveyor, FollowsItsPlayerAndWakesItsLoad) {
  const Scene scene = ParseScene(
      std::string(kAnn) + Belt("{player = \"ann\", axis = \"lift\", speed = 2}") + Crate(),
      "s.toml");
  World world(scene);
  Steps(&world, 180);
  ASSERT_FALSE(world.awake(0)) << "the belt stands still";
  world.SetInput(0, Of(127, 0));
  Steps(&world, 5);
  EXPECT_FALSE(world.awake(0)) << "drive is not its axis";
  world.SetInput(0, Of(0, -127));
  Steps(&world, 90);
  EXPECT_NEAR(world.Read(0).velocity.x(), -2, 0.02);
  world.SetInput(0, Of(0, 0));
  Steps(&world, 90);
  EXPECT_NEAR(world.Read(0).velocity.x(), 0, 0.02);
}

TEST(Conveyor, AFreeBeltIsPushedBackByItsLoad) {
  // A free belt on ice and a crate of the same mass on it: their momentum stays 0.
  const auto world =
      SmallWorld("[[part]]\nname = \"ice\"\nchain = [[-50, -1.015], [50, -1.015]]\nfriction = 0\n" +
                 std::string("[[part]]\nname = \"belt\"\nbox = [10, 1]\nposition = [0, -0.5]\n"
                             "friction = 0.4\nconveyor = 2\ndensity = 0.1\n") +
                 Crate());
  Steps(world.get(), 60);
  const float belt = world->Read(0).velocity.x(), crate = world->Read(1).velocity.x();
  EXPECT_NEAR(crate - belt, 2, 0.02);
  EXPECT_NEAR(crate + belt, 0, 1e-3);
}

TEST(Thrust, GivesFTOverMAndSpinByItsOffset) {
  // 2 x 1 m, 3 kg/m^2: m = 6, I = 6 (4 + 1)/12 = 2.5. At [1, 0] upwards: torque 3 N m.
  const auto world = SmallWorld(
      "[[part]]\nname = \"ship\"\nbox = [2, 1]\ndensity = 3\n"
      "[[thrust]]\nname = \"side\"\npart = \"ship\"\nat = [1, 0]\nforce = [0, 3]\n",
      "substeps = 4", "gravity = [0, 0]\n");
  Steps(world.get(), 12);
  EXPECT_NEAR(world->Read(0).spin, 3 / 2.5 * 0.2, 1e-3);
  EXPECT_NEAR(world->Read(0).velocity.norm(), 3 / 6.0 * 0.2, 1e-3);
}

TEST(Thrust, TurnsWithItsPartAndScalesWithTheAxis) {
  const auto world = SmallWorld(
      std::string(kAnn) +
          "[[part]]\nname = \"ship\"\nbox = [1, 1]\nangle = 1.57079633\n"
          "[[thrust]]\nname = \"engine\"\npart = \"ship\"\nforce = [8, 0]\nplayer = \"ann\"\n",
      "", "gravity = [0, 0]\n");
  Steps(world.get(), 30);
  EXPECT_EQ(world->Read(0).velocity.norm(), 0) << "nobody drives";
  world->SetInput(0, Of(127, 0));
  Steps(world.get(), 30);
  EXPECT_NEAR(world->Read(0).velocity.y(), 4, 1e-3);
  EXPECT_NEAR(world->Read(0).velocity.x(), 0, 1e-3);
  world->SetInput(0, Of(-127, 0));
  Steps(world.get(), 60);
  EXPECT_NEAR(world->Read(0).velocity.y(), -4, 2e-3);
}

TEST(Thrust, PushesWhileItsButtonIsPressedAndWakesItsBody) {
  const Scene scene = ParseScene(
      std::string(kAnn) +
          "[[part]]\nname = \"ground\"\nchain = [[-9, 0], [9, 0]]\n"
          "[[part]]\nname = \"rocket\"\nbox = [1, 1]\nposition = [0, 0.515]\n"
          "[[thrust]]\nname = \"jet\"\npart = \"rocket\"\nforce = [0, 15]\nplayer = \"ann\"\n"
          "button = 3\n",
      "s.toml");
  World world(scene);
  Steps(&world, 120);
  ASSERT_FALSE(world.awake(0));
  world.SetInput(0, Of(0, 0, 1 << 3));
  Steps(&world, 60);
  EXPECT_NEAR(world.Read(0).velocity.y(), 5, 0.05);  // F/m - g
  world.SetInput(0, Of(0, 0, 1 << 2));
  Steps(&world, 30);
  EXPECT_NEAR(world.Read(0).velocity.y(), 0, 0.05);
}

TEST(Thrust, OnAWeldedPartPushesTheWholeAssembly) {
  const auto world = SmallWorld(
      "[[part]]\nname = \"hull\"\nbox = [4, 1]\ndensity = 2\n"
      "[[part]]\nname = \"engine\"\nbox = [1, 1]\nposition = [0, 2]\nangle = 1.57079633\n"
      "[[joint]]\nname = \"w\"\nkind = \"weld\"\na = \"hull\"\nb = \"engine\"\n"
      "[[thrust]]\nname = \"jet\"\npart = \"engine\"\nforce = [0, 9]\n",
      "substeps = 4", "gravity = [0, 0]\n");
  ASSERT_EQ(world->body_count(), 1);
  Steps(world.get(), 6);
  // The engine's up is the hull's left; it pushes above the centre of mass: counter-clockwise.
  EXPECT_NEAR(world->Read(0).velocity.x(), -9 / 9.0 * 0.1, 2e-3);
  EXPECT_GT(world->Read(0).spin, 0.01f);
}

TEST(Forces, ReplayBitForBitFromABarrier) {
  World world(ParseScene(
      std::string(kAnn) + Belt("{player = \"ann\", speed = 4}") + Crate() +
          "[[part]]\nname = \"rocket\"\nbox = [1, 1]\nposition = [3, 0.515]\n"
          "[[thrust]]\nname = \"jet\"\npart = \"rocket\"\nat = [0.1, 0]\nforce = [4, 12]\n"
          "player = \"ann\"\naxis = \"lift\"\n",
      "s.toml"));
  const auto step = [&world] {
    const auto t = static_cast<int>(world.tick());
    world.SetInput(0, Of(t % 50 < 30 ? 127 : -127, t % 35 < 20 ? 127 : 0));
    world.Step();
  };
  std::vector<WorldSnapshot> barriers;
  std::vector<std::uint64_t> hashes;
  while (world.tick() < 150) {
    step();
    if (world.tick() % 3 == 0) barriers.push_back(world.Barrier());
    hashes.push_back(world.Hash());
  }
  EXPECT_TRUE(world.Restore(barriers[9]).ok());
  while (world.tick() < 150) {
    step();
    if (world.tick() % 3 == 0) world.Barrier();
    ASSERT_EQ(world.Hash(), hashes[static_cast<std::size_t>(world.tick() - 1)]) << world.tick();
  }
}

}  // namespace forces_test
}  // namespace seam
