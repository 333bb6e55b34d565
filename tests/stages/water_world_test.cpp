/// Water as a part of the world: in the contact pipeline, with sleep, roles, snapshots and welds.

#include "tests/support/water_world.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/check.h"
#include "common/stages/water/wet_shape.h"

namespace seam {
namespace water_world_test {

Scene SceneOf(const std::string& parts, const std::string& solver = "") {
  return ParseScene("[solver]\n" + solver + "\n" + parts, "test.toml");
}

const char* kDryPile =
    "[[part]]\nname = \"ground\"\nchain = [[-50, 20], [50, 20]]\n"
    "[[part]]\nname = \"a\"\nbox = [1, 1]\nposition = [0, 21]\nspin = 2\n"
    "[[part]]\nname = \"b\"\nbox = [1, 1]\nposition = [0.3, 22.5]\n";

TEST(WaterWorld, DryBodiesHaveTheSameBitsAsWithoutWater) {
  World dry(SceneOf(kDryPile)), wet(SceneOf(kDryPile + Sea()));
  for (int i = 0; i < 300; ++i) {
    dry.Step();
    wet.Step();
    ASSERT_EQ(dry.Hash(), wet.Hash()) << i;
  }
}

TEST(WaterWorld, FloatersFallAsleepInStillWater) {
  World world(SceneOf(Floater("p", "box = [2, 1]\ndensity = 0.5\nposition = [0, 0.3]") + Sea()));
  int asleep_at = -1;
  for (int i = 0; i < 60 * 60 && asleep_at < 0; ++i) {
    world.Step();
    if (!world.awake(0)) asleep_at = i;
  }
  ASSERT_GT(asleep_at, 60);
  const BodyState then = world.Read(0);
  EXPECT_NEAR(then.position.y(), 0, 5e-3);
  Steps(&world, 60);
  EXPECT_FALSE(world.awake(0));
  EXPECT_EQ(world.Read(0).position, then.position);
}

TEST(WaterWorld, AFreeFloaterDoesNotSleepInASlowFlow) {
  // 4 mm/s is below the speed at which the engine lets things fall asleep.
  World world(SceneOf(Floater("p", "box = [2, 1]\ndensity = 0.5") + Sea("flow = [0.004, 0]")));
  Steps(&world, 60 * 60);
  EXPECT_TRUE(world.awake(0));
  EXPECT_NEAR(world.Read(0).velocity.x(), 0.004, 1e-3);
  world.SetAwake(0, false);
  world.Step();
  EXPECT_TRUE(world.awake(0)) << "and wakes up there";
}

TEST(WaterWorld, AMooredFloaterMaySleepInAFlow) {
  World world(
      SceneOf(Floater("p", "circle = 0.5\ndensity = 0.5") +
              Floater("wall", "box = [1, 4]\nposition = [1.2, 0]\nanchored = true\nfriction = 1") +
              Sea("flow = [0.3, 0]")));
  Steps(&world, 60 * 60);
  EXPECT_FALSE(world.awake(0));
  EXPECT_NEAR(world.Read(0).position.x(), 0.2, 0.02);
}

TEST(WaterWorld, ABodyThatBecomesDynamicFloatsAtOnce) {
  World world(
      SceneOf(Floater("p", "box = [2, 1]\ndensity = 0.5") + Sea("viscosity = 2"), "sleep = false"));
  Steps(&world, 60 * 20);
  const float rest = world.Read(0).position.y();
  for (int round = 0; round < 3; ++round) {
    world.SetActivity(0, Activity::kKinematic);
    Steps(&world, 10);
    world.SetActivity(0, Activity::kSimulated);
    world.Step();
    EXPECT_NEAR(world.Read(0).velocity.y(), 0, 1e-3) << "a step without lift is 0.17 m/s";
    Steps(&world, 5);
    EXPECT_NEAR(world.Read(0).position.y(), rest, 1e-3);
  }
}

TEST(WaterWorld, ReplaysFromABarrierAreBitExact) {
  const Scene scene = SceneOf(
      Floater("a", "box = [2, 0.6]\ndensity = 0.4\nposition = [0, 1]\nangle = 0.4") +
      Floater("b", "circle = 0.5\ndensity = 0.7\nposition = [0.6, 3]") +
      Floater("c", "box = [1, 1]\ndensity = 0.3\nposition = [4, 2]\nvelocity = [-3, 0]") +
      Floater("d", "polygon = [[-1, 0], [1, 0], [0, 0.8]]\ndensity = 2\nposition = [-3, 0.2]") +
      Floater("bed", "box = [60, 1]\nposition = [0, -4]\nanchored = true") +
      Sea("flow = [0.2, 0]\nmethod = \"voxel4\"") +
      "[[water]]\nname = \"other\"\nbox = [6, 3]\nposition = [0.3, -1.4]\n");
  World world(scene);
  std::vector<std::uint64_t> hashes = {world.Hash()};
  std::vector<WorldSnapshot> barriers;
  for (int t = 1; t <= 400; ++t) {
    world.Step();
    if (t % 10 == 0) barriers.push_back(world.Barrier());
    hashes.push_back(world.Hash());
  }
  for (const WorldSnapshot& barrier : barriers) {
    EXPECT_TRUE(world.Restore(barrier).ok());
    for (int i = 0; i < 60 && world.tick() < 400; ++i) {
      world.Step();
      if (world.tick() % 10 == 0) world.Barrier();
      ASSERT_EQ(world.Hash(), hashes[static_cast<std::size_t>(world.tick())]) << barrier.tick;
    }
  }
}

TEST(WaterWorld, ABarrierChangesNothingForLoneFloaters) {
  const Scene scene = SceneOf(
      Floater("a", "box = [2, 0.6]\ndensity = 0.4\nposition = [0, 1]\nangle = 0.4") + Sea());
  World world(scene), plain(scene);
  for (int t = 1; t <= 120; ++t) {
    world.Step();
    world.Barrier();
    plain.Step();
    ASSERT_EQ(world.Hash(), plain.Hash()) << t;
  }
}

std::string Welded(const std::string& a, const std::string& b) {
  return Floater("a", a) + Floater("b", b) +
         "[[joint]]\nname = \"w\"\nkind = \"weld\"\na = \"a\"\nb = \"b\"\n";
}

double WetLength(const std::string& parts) {
  const Scene scene = ParseScene(parts, "test.toml");
  double length = 0;
  for (const Assembly& assembly : Compose(scene).assemblies) {
    for (const WetEdge& edge : WetShapeOf(scene, assembly).edges) {
      length += (edge.to - edge.from).norm();
    }
  }
  return length;
}

TEST(WaterWorld, FacesBetweenWeldedPartsAreNotWet) {
  EXPECT_NEAR(WetLength(Floater("a", "box = [1, 1]") + Floater("b", "box = [1, 1]")), 8, 1e-9);
  EXPECT_NEAR(WetLength(Welded("box = [1, 1]", "box = [1, 1]\nposition = [1, 0]")), 6, 2e-2);
  // Half a face; and a shape that is inside of another.
  EXPECT_NEAR(WetLength(Welded("box = [1, 1]", "box = [1, 1]\nposition = [1, 0.5]")), 7, 2e-2);
  EXPECT_NEAR(WetLength(Welded("box = [2, 2]", "box = [1, 1]\nangle = 0.3")), 8, 1e-9);
  // A disc half in a box: the box loses the diameter, the disc half of its edge.
  EXPECT_NEAR(WetLength(Welded("box = [4, 2]", "circle = 0.5\nposition = [0, 1]")),
              12 - 1 + M_PI / 2, 0.1);
  EXPECT_NEAR(WetLength(Floater("a", "circle = 1")), 2 * M_PI, 1e-9);
}

TEST(WaterWorld, TwoWeldedBoxesMoveAsTheBigBoxDoes) {
  const std::string motion = "density = 0.6\nvelocity = [3, 1]\nspin = 2\n";
  World two(SceneOf(Welded("box = [1, 1]\nposition = [-0.5, 0]\n" + motion,
                           "box = [1, 1]\nposition = [0.5, 0]\ndensity = 0.6") +
                    Sea()));
  World one(SceneOf(Floater("p", "box = [2, 1]\n" + motion) + Sea()));
  Steps(&two, 120);
  Steps(&one, 120);
  const BodyState a = two.Read(0), b = one.Read(0);
  const Vec2 middle = a.position + 0.5f * Vec2(std::cos(a.angle), std::sin(a.angle));
  EXPECT_NEAR(middle.x(), b.position.x(), 5e-3);
  EXPECT_NEAR(middle.y(), b.position.y(), 5e-3);
  EXPECT_NEAR(a.angle, b.angle, 5e-3);
  EXPECT_GT(b.position.x(), 0.5) << "they did move";
}

TEST(WaterWorld, BrokenPiecesFloatOrSinkIndividually) {
  World world(SceneOf(Welded("box = [2, 1]\ndensity = 0.2",
                             "box = [2, 0.5]\ndensity = 1.2\n"
                             "position = [0, -0.75]") +
                          Sea("viscosity = 2"),
                      "sleep = false"));
  Steps(&world, 60 * 20);
  ASSERT_EQ(world.body_count(), 1);
  EXPECT_NEAR(world.Read(0).position.y() + 0.25, 0.75 - 1.6 / 2, 0.5) << "together they float";
  EXPECT_GT(world.Read(0).position.y(), -1);
  world.Apply({Edit(BreakEdit{0})});
  ASSERT_EQ(world.body_count(), 2);
  Steps(&world, 60 * 10);
  EXPECT_NEAR(world.Read(0).position.y(), 0.5 - 0.2, 0.01);
  EXPECT_LT(world.Read(1).position.y(), -3);
}

TEST(WaterWorld, AdjacentWatersActAsOne) {
  const std::string ship = Floater("p", "box = [3, 1]\ndensity = 0.4\nvelocity = [2, 0]\nspin = 1");
  World one(SceneOf(ship + Sea()));
  World two(SceneOf(ship + "[[water]]\nname = \"l\"\nbox = [200, 50]\nposition = [-100, -25]\n"
                           "[[water]]\nname = \"r\"\nbox = [200, 50]\nposition = [100, -25]\n"));
  Steps(&one, 120);
  Steps(&two, 120);
  EXPECT_NEAR(one.Read(0).position.x(), two.Read(0).position.x(), 1e-3);
  EXPECT_NEAR(one.Read(0).angle, two.Read(0).angle, 1e-3);
  EXPECT_GT(one.Read(0).position.x(), 0.5);
}

TEST(WaterWorld, MistakesNameFileLineAndReason) {
  const auto complaint = [](const std::string& top, const std::string& water) {
    try {
      ParseScene(top + "\n[[part]]\nname = \"p\"\nbox = [1, 1]\n[[water]]\n" + water, "s.toml");
    } catch (const OperatorError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const std::string good = "name = \"sea\"\nbox = [9, 9]\n";  // lines 6 and 7
  EXPECT_EQ(complaint("", good), "");
  const struct {
    std::string top, water, says;
  } mistakes[] = {
      {"", "box = [9, 9]\n", "s.toml:5: water: name is missing"},
      {"", "name = \"sea\"\n", "s.toml:5: water 'sea': box is missing"},
      {"", good + "densty = 1", "s.toml:8: water: unknown key 'densty' (did you mean 'density'?)"},
      {"", good + "density = 0", "s.toml:8: water 'sea': density must be a number from 0.01"},
      {"", good + "flow = [51, 0]", "s.toml:8: water 'sea': flow"},
      {"", good + "viscosity = -1", "s.toml:8: water 'sea': viscosity"},
      {"", good + "drag_normal = nan", "s.toml:8: water 'sea': drag_normal"},
      {"", good + "drag_tangent = 101", "s.toml:8: water 'sea': drag_tangent"},
      {"", good + "method = \"voxl\"", "s.toml:8: water 'sea': method must be exact, voxel4"},
      {"", good + "method = \"voxel\"", "s.toml:5: water 'sea': n is missing"},
      {"", good + "method = \"voxel\"\nn = 1", "s.toml:9: water 'sea': n must be"},
      {"", good + "n = 4", "s.toml:8: water 'sea': only method 'voxel' has n"},
      {"", "name = \"sea\"\nbox = [9, 0]", "s.toml:7: water 'sea': box must be"},
      {"", good + "[[water]]\n" + good, "s.toml:9: water 'sea': there is another water"},
      {"gravity = [1, -10]", good, "s.toml:1: scene: water is level"},
      {"gravity = [0, 10]", good, "s.toml:1: scene: water is level"},
  };
  for (const auto& m : mistakes) {
    EXPECT_EQ(complaint(m.top, m.water).substr(0, m.says.size()), m.says);
  }
}

}  // namespace water_world_test
}  // namespace seam
