/// Many anchored parts share few bodies, and act as if each had its own.

#include "common/physics/anchored/anchored_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/physics/part_places.h"
#include "common/physics/world_build.h"
#include "tests/support/living_world.h"

namespace seam {
namespace anchored_bodies_test {

constexpr int kDense = static_cast<int>(kDenseFrom);

int CountShared(const Scene& scene) {
  const Composition composition = Compose(scene);
  const std::vector<bool> share =
      ShareBodies(scene, composition, DenseAnchored(scene, composition));
  return static_cast<int>(std::count(share.begin(), share.end(), true));
}

/// Anchored tiles in a row whose top is at 0, turned by an angle about the origin.
std::string Tiles(int count, double angle = 0) {
  const double c = std::cos(angle), s = std::sin(angle), from = -0.5 * (count - 1);
  return "[[part]]\nname = \"tile\"\nbox = [1, 1]\nposition = [" + FloatDigits(from * c + 0.5 * s) +
         ", " + FloatDigits(from * s - 0.5 * c) + "]\nangle = " + FloatDigits(angle) +
         "\nfriction = 0.6\nanchored = true\nrepeat = {count = " + std::to_string(count) +
         ", step = [" + FloatDigits(c) + ", " + FloatDigits(s) + "]}\n";
}

TEST(AnchoredBodies, OnlyManyPartsWithoutJointsShareABody) {
  EXPECT_EQ(CountShared(ParseScene(Tiles(kDense - 1), "a.toml")), 0);
  EXPECT_EQ(CountShared(ParseScene(Tiles(kDense), "a.toml")), kDense);
  const std::string door =
      "[[part]]\nname = \"door\"\nbox = [0.2, 2]\nposition = [0, 1.2]\n"
      "[[joint]]\nname = \"hinge\"\nkind = \"revolute\"\na = \"tile.3\"\nb = \"door\"\n"
      "anchor = [0, 0.2]\n";
  EXPECT_EQ(CountShared(ParseScene(Tiles(40) + door, "a.toml")), 39);
  const std::string belt =
      "[[part]]\nname = \"belt\"\nbox = [4, 1]\nposition = [0, -5]\nanchored = true\n"
      "conveyor = {speed = 2}\n";
  EXPECT_EQ(CountShared(ParseScene(Tiles(40) + belt, "a.toml")), 40);
  const std::string glued =
      "[[part]]\nname = \"sign\"\nbox = [1, 1]\nposition = [0, 0.51]\n"
      "[[joint]]\nname = \"nail\"\nkind = \"glue\"\na = \"tile.20\"\nb = \"sign\"\n"
      "strength = 100\n";
  EXPECT_EQ(CountShared(ParseScene(Tiles(40) + glued, "a.toml")), 39);
}

/// A box slides down a slope; where it is after two seconds.
BodyState Slid(int tiles, double angle) {
  const double x = 5 * std::cos(angle) - 0.52 * std::sin(angle);
  const double y = 5 * std::sin(angle) + 0.52 * std::cos(angle);
  auto world =
      SmallWorld(Tiles(tiles, angle) + "[[part]]\nname = \"box\"\nbox = [1, 1]\nposition = [" +
                 FloatDigits(x) + ", " + FloatDigits(y) + "]\nangle = " + FloatDigits(angle) +
                 "\nfriction = 0.1\n");
  Live(world.get(), 120);
  return world->Read(0);
}

TEST(AnchoredBodies, ASlopeOfTilesIsTheSameOfOwnAndOfSharedBodies) {
  for (const double angle : {0.0, 0.35, -0.2}) {
    const BodyState own = Slid(kDense - 2, angle), shared = Slid(kDense, angle);
    // Rounded edges make another blow of each seam: a hundredth of the way.
    EXPECT_LT((own.position - shared.position).norm(), 0.1f) << angle;
    EXPECT_NEAR(own.angle, shared.angle, 2e-2f) << angle;
  }
}

TEST(AnchoredBodies, AMechanismOnTilesIsTheSameOnOwnAndOnSharedBodies) {
  const auto driven = [](int tiles) {
    auto world = SmallWorld(
        Tiles(tiles) +
        "[[part]]\nname = \"car\"\nbox = [2, 0.4]\nposition = [-8, 0.62]\n"
        "[[part]]\nname = \"wheel\"\ncircle = 0.4\nposition = [-8.7, 0.41]\nfriction = 0.9\n"
        "repeat = {count = 2, step = [1.4, 0]}\n"
        "[[joint]]\nname = \"rear\"\nkind = \"revolute\"\na = \"car\"\nb = \"wheel.0\"\n"
        "anchor = [-8.7, 0.41]\nmotor = {speed = -5, torque = 20}\n"
        "[[joint]]\nname = \"front\"\nkind = \"revolute\"\na = \"car\"\nb = \"wheel.1\"\n"
        "anchor = [-7.3, 0.41]\n");
    Live(world.get(), 240);
    return world->Read(0);
  };
  const BodyState own = driven(kDense - 2), shared = driven(kDense);
  EXPECT_GT(own.position.x(), -3) << "it drives";
  EXPECT_LT((own.position - shared.position).norm(), 0.02f);
}

TEST(AnchoredBodies, ATouchNamesTheTile) {
  auto world = SmallWorld(Tiles(40) +
                          "[[part]]\nname = \"ball\"\ncircle = 0.3\nposition = [7.5, "
                          "0.31]\n");
  Live(world.get(), 60);
  const std::vector<PartTouch> touches = world->PartTouches();
  ASSERT_EQ(touches.size(), 1u);
  // Tiles are parts 0..39 from x = -19.5 on, the ball is part 40.
  EXPECT_EQ(touches[0].a, 27);
  EXPECT_EQ(touches[0].b, 40);
}

TEST(AnchoredBodies, TilesWithoutRoomBetweenThemAreFewShapes) {
  // 20 rows of 40, turned: 30 m by 14 m, on a dozen squares of 16 m.
  const auto shapes = [](double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    std::string text;
    for (int row = 0; row < 20; ++row) {
      const double x = -14.6, y = -0.5 - 0.7 * row;
      text += "[[part]]\nname = \"r" + std::to_string(row) + "\"\nbox = [0.75, 0.7]\nposition = [" +
              FloatDigits(x * c - y * s) + ", " + FloatDigits(x * s + y * c) +
              "]\nangle = " + FloatDigits(angle) +
              "\nanchored = true\nrepeat = {count = 40, step = [" + FloatDigits(0.75 * c) + ", " +
              FloatDigits(0.75 * s) + "]}\n";
    }
    const Scene scene = ParseScene(text, "tiles.toml");
    b2World world(b2Vec2(0, 0));
    BuildScene(scene, Compose(scene), &world);
    return world.GetProxyCount();
  };
  EXPECT_LE(shapes(0), 12);
  for (const double angle : {0.3, 0.8, -1.2}) EXPECT_LE(shapes(angle), 200) << angle;
}

TEST(AnchoredBodies, AFarWallIsAsSmoothAsANearOne) {
  // Shapes 3 km from their body's origin would have lost their edges.
  const auto fallen = [](double at) {
    auto world =
        SmallWorld("[[part]]\nname = \"tile\"\nbox = [1, 1]\nposition = [" + FloatDigits(at - 20) +
                       ", -0.5]\nanchored = true\nrepeat = {count = 40, step = [1, 0]}\n"
                       "[[part]]\nname = \"box\"\nbox = [1, 1]\nposition = [" +
                       FloatDigits(at) + ", 0.6]\n",
                   "", "bounds = [[-4000, -100], [4000, 100]]\n");
    Live(world.get(), 120);
    return world->Read(0);
  };
  const BodyState near = fallen(0), far = fallen(3000);
  EXPECT_NEAR(near.position.y(), far.position.y(), 1e-3f);
  EXPECT_LT(std::fabs(far.angle), 1e-3f);
  EXPECT_LT(far.velocity.norm(), 1e-2f);
}

TEST(AnchoredBodies, AFreedOneFallsAndTheOthersStay) {
  auto world =
      SmallWorld(Tiles(40) + "[[part]]\nname = \"floor\"\nchain = [[-30, -9], [30, -9]]\n");
  EXPECT_EQ(world->body_count(), 0);
  world->Apply({Edit(FreeEdit{17}, EditCause::kOutside)});
  ASSERT_EQ(world->body_count(), 1);
  EXPECT_EQ(world->id(0), 17);
  const Vec2 at = world->Read(0).position;
  Live(world.get(), 30);
  EXPECT_LT(world->Read(0).position.y(), at.y() - 0.3f);
  EXPECT_EQ(PartPose(*world, 18).position, world->scene().parts[18].position);
  const int assembly = world->composition().assembly_of_part[18];
  EXPECT_EQ(world->ReadAssembly(assembly).position, world->scene().parts[18].position);
}

TEST(AnchoredBodies, AWeldedWallComesDownWhenItIsNoLongerAnchored) {
  const std::string wall =
      "[[part]]\nname = \"ledge\"\nbox = [1, 14]\nposition = [0, 7]\nanchored = true\n"
      "[[part]]\nname = \"slab\"\nbox = [1, 1]\nposition = [1, 13]\n"
      "[[joint]]\nname = \"weld\"\nkind = \"weld\"\na = \"ledge\"\nb = \"slab\"\n";
  auto world = SmallWorld(Tiles(40) + wall);
  EXPECT_EQ(CountShared(world->scene()), 41);
  EXPECT_EQ(world->body_count(), 0);
  world->Apply({Edit(BreakEdit{0}, EditCause::kOutside)});
  ASSERT_EQ(world->body_count(), 1);
  Live(world.get(), 60);
  EXPECT_LT(world->Read(0).position.y(), 11);
}

/// Twenty welded rows of forty boxes with 0.3 m between them, turned about the origin; twenty balls
/// rest on the uppermost, under a gravity that is turned likewise.
std::string Rows(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto at = [&](double x, double y) {
    return "position = [" + FloatDigits(x * c - y * s) + ", " + FloatDigits(x * s + y * c) + "]\n";
  };
  std::string text = "gravity = [" + FloatDigits(10 * s) + ", " + FloatDigits(-10 * c) + "]\n";
  text += "[solver]\nsleep = false\n";
  for (int row = 0; row < 20; ++row) {
    text += "[[part]]\nname = \"r" + std::to_string(row) + "\"\nbox = [1, 0.5]\n" +
            at(-19.5, -0.8 * row) + "angle = " + FloatDigits(angle) +
            "\nanchored = true\nrepeat = {count = 40, step = [" + FloatDigits(c) + ", " +
            FloatDigits(s) + "], weld = true}\n";
  }
  for (int i = 0; i < 20; ++i) {
    text += "[[part]]\nname = \"m" + std::to_string(i) + "\"\ncircle = 0.3\n" +
            at(1.9 * (i - 9.5), 0.56);
  }
  return text;
}

TEST(AnchoredBodies, TurnedRowsContactOnlyNearbyBodies) {
  const auto contacts = [](double angle) {
    const Scene scene = ParseScene(Rows(angle), "rows.toml");
    b2World world(b2Vec2(scene.gravity.x(), scene.gravity.y()));
    world.SetAllowSleeping(false);
    BuildScene(scene, Compose(scene), &world);
    for (int t = 0; t < 120; ++t) {
      DropFarContacts(&world);
      world.Step(1.0f / 60, 8, 3);
    }
    return world.GetContactCount();
  };
  const int level = contacts(0);
  EXPECT_EQ(level, 20) << "one for each ball";
  for (const double angle : {0.02, 0.3, 0.8, 1.4, -2.5}) {
    EXPECT_LE(contacts(angle), level) << angle;
  }
}

TEST(AnchoredBodies, NothingGetsThroughTurnedWalls) {
  // Four welded walls of 14 boxes around 10 m x 10 m, turned; discs and boxes at up to 110 m/s.
  for (const double angle : {0.3, 0.8, -1.2}) {
    std::string text;
    for (int side = 0; side < 4; ++side) {
      const double a = angle + side * kPi / 2, c = std::cos(a), s = std::sin(a);
      text += "[[part]]\nname = \"w" + std::to_string(side) +
              "\"\nbox = [0.8, 0.4]\nrestitution = 0.6\nposition = [" +
              FloatDigits(-5.2 * c + 5.2 * s) + ", " + FloatDigits(-5.2 * s - 5.2 * c) +
              "]\nangle = " + FloatDigits(a) + "\nanchored = true\nrepeat = {count = 14, step = [" +
              FloatDigits(0.8 * c) + ", " + FloatDigits(0.8 * s) + "], weld = true}\n";
    }
    for (int i = 0; i < 60; ++i) {
      const double a = 2.4 * i, speed = 20 + 1.5 * i;
      text += "[[part]]\nname = \"m" + std::to_string(i) + "\"\n" +
              (i % 2 == 0 ? "circle = 0.1" : "box = [0.2, 0.15]") + "\nposition = [" +
              FloatDigits(0.05 * i * std::cos(a)) + ", " + FloatDigits(0.05 * i * std::sin(a)) +
              "]\nvelocity = [" + FloatDigits(speed * std::cos(3 * a)) + ", " +
              FloatDigits(speed * std::sin(3 * a)) + "]\n";
    }
    auto world = SmallWorld(text);
    for (int t = 0; t < 240; ++t) {
      Live(world.get(), 1);
      if (t % 50 == 49) world->Barrier();
      for (int i = 0; i < world->body_count(); ++i) {
        ASSERT_LT(world->Read(i).position.norm(), 7.8f) << angle << ", tick " << t << ", " << i;
      }
    }
  }
}

TEST(AnchoredBodies, ABarrierAmongThemIsBitExact) {
  const std::string balls =
      "[[part]]\nname = \"ball\"\ncircle = 0.3\nposition = [-8, 1]\nvelocity = [3, 0]\n"
      "restitution = 0.5\nrepeat = {count = 8, step = [2, 0.3]}\n";
  auto world = SmallWorld(Tiles(60, 0.1) + balls);
  Live(world.get(), 50);
  const WorldSnapshot then = world->Barrier();
  std::vector<std::uint64_t> first, again;
  for (int i = 0; i < 60; ++i) {
    world->Step();
    first.push_back(world->Hash());
  }
  ASSERT_TRUE(world->Restore(then).ok());
  for (int i = 0; i < 60; ++i) {
    world->Step();
    again.push_back(world->Hash());
  }
  EXPECT_EQ(first, again);
}

}  // namespace anchored_bodies_test
}  // namespace seam
