/// The skin of `[solver]`: bodies rest in contact, and nothing passes through thin floors.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "common/base/random.h"
#include "common/physics/world.h"

namespace seam {
namespace world_skin_test {

/// Ground whose surface is y = 0, as a box or as a chain.
std::string Ground(bool chain) {
  return chain ? "[[part]]\nname = \"ground\"\nchain = [[-50, 0], [50, 0]]\n"
               : "[[part]]\nname = \"ground\"\nbox = [100, 1]\nposition = [0, -0.5]\n"
                 "anchored = true\n";
}

const char* kPile =
    "[[part]]\nname = \"low\"\nbox = [1, 1]\nposition = [0, 0.5]\n"
    "[[part]]\nname = \"high\"\nbox = [1, 1]\nposition = [0, 1.5]\n"
    "[[part]]\nname = \"disc\"\ncircle = 0.5\nposition = [3, 0.5]\n"
    "[[part]]\nname = \"on-top\"\ncircle = 0.5\nposition = [0, 2.5]\n"
    "[[part]]\nname = \"wedge\"\npolygon = [[-0.5, -0.3], [0.5, -0.3], [0, 0.6]]\n"
    "position = [6, 0.3]\n";

/// Heights of the pile's bodies after four seconds; each begins `lift` m above its support.
std::vector<float> Rest(const std::string& solver, bool chain, float lift) {
  Scene scene = ParseScene("[solver]\n" + solver + "\n" + Ground(chain) + kPile, "s.toml");
  for (Part& part : scene.parts) {
    if (!part.anchored) part.position.y() += lift * std::ceil(part.position.y());
  }
  World world(scene);
  for (int i = 0; i < 240; ++i) world.Step();
  std::vector<float> heights;
  for (int body = 0; body < world.body_count(); ++body) {
    heights.push_back(world.Read(body).position.y());
  }
  return heights;
}

TEST(Skin, AtHalfTheSlopBodiesRestInContact) {
  const std::vector<float> right = {0.5f, 1.5f, 0.5f, 2.5f, 0.3f};
  for (const bool chain : {false, true}) {
    const std::vector<float> got = Rest("skin = 0.0025", chain, 0);
    ASSERT_EQ(got.size(), right.size());
    for (std::size_t i = 0; i < right.size(); ++i) EXPECT_NEAR(got[i], right[i], 5e-4f) << i;
  }
}

TEST(Skin, TheEnginesDefaultLetsBoxesRestFifteenMillimetresApart) {
  // A falling body stops anywhere within the slop of 5 mm.
  const std::vector<float> got = Rest("", false, 0.03f);
  EXPECT_NEAR(got[0], 0.5f + 0.0175f, 3e-3f);
  EXPECT_NEAR(got[1], 1.5f + 0.035f, 6e-3f);
}

TEST(Skin, AWiderSkinWidensEveryGapByTheSame) {
  const float apart = 2 * 0.008f - 0.0025f;  // in the middle of the slop
  const std::vector<float> got = Rest("skin = 0.008", true, 0.03f);
  EXPECT_NEAR(got[0], 0.5f + apart, 3e-3f);
  EXPECT_NEAR(got[1], 1.5f + 2 * apart, 6e-3f);
  EXPECT_NEAR(got[2], 0.5f + apart, 3e-3f);
}

/// Shoots boxes and discs of many sizes, angles and speeds down at a floor 2 cm thick.
/// How many are below it after a second, out of 600.
int Through(float skin) {
  Scene scene = ParseScene(Ground(false), "s.toml");
  scene.solver.skin = skin;
  scene.solver.sleep = false;
  scene.parts[0].position = Vec2(900, -0.01f);
  scene.parts[0].size = Vec2(2000, 0.02f);
  Random random(7);
  const auto between = [&random](double low, double high) {
    return static_cast<float>(low + (high - low) * random.Uniform());
  };
  for (int i = 0; i < 600; ++i) {
    Part part;
    part.id = i + 1;
    part.name = "shot." + std::to_string(i);
    part.kind = i % 3 == 0 ? ShapeKind::kCircle : ShapeKind::kBox;
    part.size = Vec2(between(0.05, 0.4), between(0.05, 0.4));
    part.radius = between(0.025, 0.2);
    part.position = Vec2(3 * static_cast<float>(i), between(1, 3));
    part.angle = between(0, 6.28);
    part.velocity = Vec2(between(-20, 20), -between(10, 100));
    part.spin = between(-30, 30);
    part.filter.group = -1;
    scene.parts.push_back(part);
  }
  World world(scene);
  for (int i = 0; i < 60; ++i) world.Step();
  int through = 0;
  for (int body = 0; body < world.body_count(); ++body) {
    if (world.Read(body).position.y() < -0.05f) ++through;
  }
  return through;
}

TEST(Skin, TheThinnestSkinLetsNothingThroughAThinFloor) { EXPECT_EQ(Through(0.0025f), 0); }

TEST(Skin, AThinnerSkinWouldLetShotsThrough) {
  // The limit of the scene file prevents this: a sum of rims of 1.01 cm is not enough.
  EXPECT_GT(Through(0.0001f), 0);
}

TEST(Skin, AValueOutOfRangeIsAMistake) {
  EXPECT_ANY_THROW(ParseScene("[solver]\nskin = 0.002\n" + Ground(true), "s.toml"));
  EXPECT_ANY_THROW(ParseScene("[solver]\nskin = 0.02\n" + Ground(true), "s.toml"));
}

}  // namespace world_skin_test
}  // namespace seam
