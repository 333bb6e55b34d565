/// The scene to play in: it matches its title in a single world, and nothing in it is a dead end.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "common/scene/part_rules.h"
#include "common/scene/water.h"
#include "tests/support/scripted_world.h"

namespace seam {
namespace arena_scene_test {

Input Drive(float share) {
  Input input;
  input.drive = static_cast<std::int8_t>(127 * share);
  return input;
}

TEST(Arena, HasTwoCarsABallAndAGoalAtEitherEnd) {
  ScriptedWorld run("arena");
  const Scene& scene = run.world.scene();
  ASSERT_EQ(scene.players.size(), 2u);
  EXPECT_GE(run.Body("car-a"), 0);
  EXPECT_GE(run.Body("car-b"), 0);
  EXPECT_GE(run.Body("ball"), 0);
  EXPECT_EQ(scene.waters.size(), 1u);
  EXPECT_EQ(scene.triggers.size(), 2u);
  float highest = 0;
  while (run.world.tick() < 360) {
    run.Step();
    highest = std::max(highest, run.Read("car-a").position.y());
  }
  EXPECT_GT(highest, 2.5) << "it flies from the ramp";
}

/// Puts the car of the letter elsewhere, since a parked car keeps its goal.
void Shift(const std::string& letter, float by, Scene* scene) {
  for (Part& part : scene->parts) {
    const bool own = part.name == "car-" + letter || part.name.rfind("wheel-" + letter, 0) == 0;
    if (own) part.position.x() += by;
  }
  for (Joint& joint : scene->joints) {
    if (joint.name.rfind("axle-" + letter, 0) != 0) continue;
    joint.anchor_a.x() += by;
    joint.anchor_b.x() += by;
  }
}

/// Drives to and fro, but mostly one way; returns the ball's farthest place on that way.
float Push(int player, float way) {
  Scene scene = LoadScene("scenes/arena.toml");
  Shift(player == 0 ? "b" : "a", player == 0 ? -54.0f : 54.0f, &scene);
  ScriptedWorld run(scene);
  float farthest = 0;
  while (run.world.tick() < 3600) {
    run.world.SetInput(player, Drive(run.world.tick() % 300 < 240 ? way : -way));
    run.world.Step();
    farthest = way < 0 ? std::min(farthest, run.Read("ball").position.x())
                       : std::max(farthest, run.Read("ball").position.x());
  }
  return farthest;
}

TEST(Arena, ACarAloneCanBringTheBallIntoTheOthersGoal) {
  EXPECT_GT(Push(0, 1), 29) << "ann, over the bridge into the right goal";
  EXPECT_LT(Push(1, -1), -29) << "bob, over the ramp into the left goal";
}

TEST(Arena, ACarThatLiesOnItsRoofIsUprightAgainByAButton) {
  ScriptedWorld run("arena");
  run.StepTo(30);
  for (int button = 0; button < 2; ++button) {
    const int before = static_cast<int>(run.world.tick());
    run.world.Act(0, button);
    float turned = 0, risen = 0;
    while (run.world.tick() < before + 60) {
      run.world.Step();
      turned = std::max(turned, std::abs(run.Read("car-a").angle));
      risen = std::max(risen, run.Read("car-a").position.y());
    }
    EXPECT_GT(risen, 1.5) << button;
    if (button == 0) continue;
    EXPECT_GT(turned, 0.3) << "it turns the car";
  }
}

}  // namespace arena_scene_test
}  // namespace seam
