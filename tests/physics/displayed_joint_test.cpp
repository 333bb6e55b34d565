/// Joints to bodies that are not simulated: a peer moves a displayed body along a path, and jointed
/// bodies must stay finite.

#include <gtest/gtest.h>

#include <cmath>

#include "common/physics/world.h"

namespace seam {
namespace displayed_joint_test {

TEST(DisplayedJoint, ASpringBetweenAnAnchorAndADisplayedBodyStaysFinite) {
  const Scene scene = ParseScene(R"(
[[part]]
name = "foot"
box = [0.6, 0.2]
anchored = true

[[part]]
name = "plank"
box = [4, 0.2]
position = [0, 2]

[[joint]]
name = "spring"
kind = "distance"
a = "foot"
b = "plank"
frequency = 0.5
)",
                                 "spring.toml");
  World world(scene);
  world.SetActivity(0, Activity::kKinematic);
  for (int i = 0; i < 30; ++i) world.Step();
  EXPECT_EQ(world.Read(0).position, Vec2(0, 2));
  EXPECT_EQ(world.Read(0).velocity, Vec2(0, 0));
  // Simulated again it falls, and the spring carries it.
  world.SetActivity(0, Activity::kSimulated);
  for (int i = 0; i < 600; ++i) world.Step();
  EXPECT_LT(world.Read(0).position.y(), 1.99f);
  EXPECT_GT(world.Read(0).position.y(), 0.1f);
}

TEST(DisplayedJoint, WhollyDisplayedScenesStayFinite) {
  for (const char* name : {"seesaw", "harbour", "crane", "obstacle", "train", "titanic"}) {
    World world(LoadScene("scenes/" + std::string(name) + ".toml"));
    for (int body = 0; body < world.body_count(); ++body) {
      world.SetActivity(body, Activity::kKinematic);
    }
    for (int i = 0; i < 10; ++i) world.Step();
    for (int body = 0; body < world.body_count(); ++body) {
      ASSERT_TRUE(world.Read(body).position.allFinite()) << name << " " << body;
      ASSERT_TRUE(std::isfinite(world.Read(body).angle)) << name << " " << body;
    }
  }
}

}  // namespace displayed_joint_test
}  // namespace seam
