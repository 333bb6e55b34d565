/// scenes/titanic.toml and scenes/gluehouse.toml match their titles in one world.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/scripted_world.h"

namespace seam {
namespace assembly_scenes_test {

int Broken(const World& world) {
  const auto& joints = world.scene().joints;
  return static_cast<int>(
      std::count_if(joints.begin(), joints.end(), [](const Joint& j) { return j.gone; }));
}

TEST(Titanic, FloatsOverTheSeamWholeAndLosesItsBowAtTheIceberg) {
  ScriptedWorld ship("titanic");
  EXPECT_EQ(ship.world.body_count(), 2);
  EXPECT_GE(ship.world.scene().parts.size(), 1000u);
  ship.StepTo(150);
  EXPECT_EQ(Broken(ship.world), 0) << "water alone breaks nothing";
  EXPECT_EQ(ship.world.body_count(), 2);
  EXPECT_NEAR(ship.Read("keel").angle, 0, 0.05) << "on an even keel";
  ship.StepTo(14 * 60);
  EXPECT_GE(Broken(ship.world), 10);
  const Vec2 bow = ship.Read("bow.0.0").position, keel = ship.Read("keel").position;
  EXPECT_GT(keel.x(), 2) << "the hull crosses the seam";
  EXPECT_LT(bow.y(), keel.y()) << "the bow sinks";
}

TEST(GlueHouse, StandsUntilItIsHitAndThenBreaksAndJoins) {
  ScriptedWorld house("gluehouse");
  const int whole = house.world.body_count();
  house.StepTo(60);
  EXPECT_EQ(Broken(house.world), 0);
  EXPECT_EQ(house.world.body_count(), whole);
  house.StepTo(4 * 60);
  EXPECT_GE(Broken(house.world), 3);
  EXPECT_GT(house.world.body_count(), whole);
  const std::size_t joints = house.world.scene().joints.size();
  house.StepTo(13 * 60);
  EXPECT_GT(house.world.scene().joints.size(), joints) << "pieces joined again";
}

}  // namespace assembly_scenes_test
}  // namespace seam
