/// A blast frees bricks as parts, thrown outwards, and nothing else.

#include "common/topology/feather_blast.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/scene/bricks.h"
#include "common/scene/mass.h"
#include "common/scene/scene_limits.h"

namespace seam {
namespace feather_blast_test {

std::vector<BrickField> Wall(float strength = 0) {
  BrickField wall;
  wall.name = "wall";
  wall.x = -100;
  wall.columns = 40;
  wall.rows = 60;
  wall.density = 2;
  wall.strength = strength;
  return {wall};
}

double MassOf(const std::vector<Part>& parts) {
  double mass = 0;
  for (const Part& part : parts) mass += PartProperties(part).mass;
  return mass;
}

TEST(BrickBlast, FreesTheBricksWithinItsRadiusAsPartsOfTheSameMass) {
  const Freed freed = BlastBricks(Wall(), FeatherStore(Wall()), {Vec2(2, 6), 1.5f, 20});
  // 1.5 m: area 7.07 m^2, bricks of 0.125 m^2 whose middles are inside.
  EXPECT_NEAR(static_cast<double>(freed.bricks.size()), 7.07 / 0.125, 4);
  EXPECT_LE(freed.parts.size(), static_cast<std::size_t>(kBlastPiecesMax));
  EXPECT_LT(freed.parts.size(), freed.bricks.size() / 2) << "most fly together";
  EXPECT_NEAR(MassOf(freed.parts), 0.25 * static_cast<double>(freed.bricks.size()), 1e-4);
  for (const Part& part : freed.parts) {
    EXPECT_FALSE(part.anchored);
    const Vec2 out = part.position - Vec2(2, 6);
    EXPECT_GT(out.dot(part.velocity), 0);
    EXPECT_NEAR(part.velocity.norm(), 20 * (1 - out.norm() / 1.5f), 1e-3);
    EXPECT_NEAR(out.x() * part.velocity.y() - out.y() * part.velocity.x(), 0, 1e-3);
  }
}

TEST(BrickBlast, IsPossibleWithinItsBoundsOnly) {
  const Blast good{{1e6f, -1e6f}, kBlastRadiusMax, kSpeedMax, kBlastImpulseMax};
  EXPECT_TRUE(Possible(good));
  for (const float far : {-1.1e6f, 3e38f, -3e38f, INFINITY, NAN}) {
    Blast bad = good;
    bad.centre.y() = far;
    EXPECT_FALSE(Possible(bad)) << far;
  }
  Blast bad = good;
  bad.radius = std::nextafter(kBlastRadiusMax, INFINITY);
  EXPECT_FALSE(Possible(bad));
}

TEST(BrickBlast, PartsCoverTheFreedBricksExactly) {
  const Freed freed = BlastBricks(Wall(), FeatherStore(Wall()), {Vec2(-3, 14), 2, 20});
  FeatherStore store(Wall());
  ASSERT_EQ(store.Remove(freed.bricks), freed.bricks.size()) << "each was there, once";
  for (const Brick& b : freed.bricks) {
    const Vec2 middle =
        Vec2(static_cast<float>(2 * b.x + 10), static_cast<float>(2 * b.y + 5)) * (kBrickUnit / 2);
    int covering = 0;
    for (const Part& part : freed.parts) {
      const Vec2 d = (middle - part.position).cwiseAbs();
      covering += d.x() < part.size.x() / 2 && d.y() < part.size.y() / 2;
    }
    EXPECT_EQ(covering, 1);
  }
}

TEST(BrickBlast, FreesAtMostFortyPiecesNearestFirst) {
  const Freed freed = BlastBricks(Wall(), FeatherStore(Wall()), {Vec2(0, 7), 7, 30});
  ASSERT_EQ(freed.parts.size(), static_cast<std::size_t>(kBlastPiecesMax));
  float farthest = 0;
  for (const Part& part : freed.parts) {
    farthest = std::max(farthest, (part.position - Vec2(0, 7)).norm());
  }
  EXPECT_LT(farthest, 3) << "40 pieces of four are a disc of 2.5 m";
}

TEST(BrickBlast, StrongBricksStayAndTakenOnesDoNotComeAgain) {
  const Blast blast{Vec2(2, 6), 1.5f, 20};
  const Freed weak = BlastBricks(Wall(0), FeatherStore(Wall(0)), blast),
              strong = BlastBricks(Wall(10), FeatherStore(Wall(10)), blast);
  // Half the speed at half the radius: a quarter of the area.
  EXPECT_NEAR(static_cast<double>(strong.bricks.size()),
              static_cast<double>(weak.bricks.size()) / 4, 4);
  EXPECT_TRUE(BlastBricks(Wall(20), FeatherStore(Wall(20)), blast).bricks.empty());
  FeatherStore left(Wall(0));
  left.Remove(weak.bricks);
  EXPECT_TRUE(BlastBricks(Wall(0), left, blast).bricks.empty());
  EXPECT_TRUE(BlastBricks(Wall(0), FeatherStore(Wall(0)), {Vec2(200, 6), 5, 20}).bricks.empty());
}

}  // namespace feather_blast_test
}  // namespace seam
