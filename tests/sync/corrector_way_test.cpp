/// Corrections do not take a copy through anchored bodies.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/support/followed_copy.h"

namespace seam {
namespace corrector_way_test {

const char* const kGround =
    "[[part]]\nname = \"ground\"\nchain = [[-50, 0], [50, 0]]\n"
    "[[part]]\nname = \"ball\"\ncircle = 0.3\nposition = [0, 9]\nvelocity = [2, -8]\n";

TEST(CorrectorWay, AFreePathEndsAtAnAnchoredCollider) {
  const World world(ParseScene(R"(
[[part]]
name = "wall"
box = [1, 4]
position = [5, 0]
anchored = true
[[part]]
name = "ball"
circle = 0.3
position = [0, 0]
[[part]]
name = "other"
circle = 0.3
position = [2, 0]
[[part]]
name = "hung"
circle = 0.3
position = [3, 0]
[[joint]]
name = "hook"
kind = "hinge"
a = "wall"
b = "hung"
anchor = [5, 0]
)",
                               "s.toml"));
  const int ball = world.BodyOfId(1), hung = world.BodyOfId(3);
  EXPECT_NEAR(world.FreeWay(ball, {0, 0}, {10, 0}), 0.45f, 1e-4f) << "others are no obstacle";
  EXPECT_EQ(world.FreeWay(ball, {0, 0}, {4, 0}), 1);
  EXPECT_EQ(world.FreeWay(ball, {0, 5}, {10, 5}), 1);
  EXPECT_EQ(world.FreeWay(ball, {1, 1}, {1, 1}), 1);
  EXPECT_EQ(world.FreeWay(hung, {0, 0}, {10, 0}), 1) << "it hangs from the wall";
}

/// The authority's ball comes down fast; the copy is somewhere else, hears of it late, and carries
/// the difference on: below the ground it would fall for ever, as it does at the authority once the
/// copy is that.
TEST(CorrectorWay, ACopyIsNeverCarriedThroughTheGround) {
  for (const char* rule : {"retrospect", "compensated", "fade", "interleave"}) {
    for (const int late : {6, 12, 20}) {
      for (const float height : {0.31f, 1.0f, 2.0f, 4.0f}) {
        FollowedCopy pair(kGround, rule, late);
        pair.Steps(30);
        BodyState wrong = pair.copy_world().Read(0);
        wrong.position = {0, height};
        wrong.velocity = {0, 0};
        pair.PutCopy(0, wrong);
        float lowest = height;
        for (int tick = 0; tick < 120; ++tick) {
          pair.Step();
          lowest = std::min(lowest, pair.copy_world().Read(0).position.y());
        }
        EXPECT_GT(lowest, 0) << rule << ", " << late << " ticks late, from " << height << " m";
      }
    }
  }
}

/// A copy that has bounced off a wall's edge to the other side stays there: its own path led there,
/// although the straight one from the authority's state does not.
TEST(CorrectorWay, ACopyThatBouncedRoundACornerStaysThere) {
  FollowedCopy pair(
      "gravity = [0, 0]\n[[part]]\nname = \"wall\"\nbox = [0.2, 4]\nposition = [0, -2.4]\n"
      "anchored = true\n[[part]]\nname = \"pin\"\ncircle = 0.5\nposition = [3, 3]\n"
      "anchored = true\n[[part]]\nname = \"ball\"\ncircle = 0.3\nposition = [-4, 0]\n"
      "velocity = [8, 0]\n",
      "retrospect", 12);
  pair.Steps(90);
  EXPECT_LT(pair.Apart(0).norm(), 0.01f);
  EXPECT_GT(pair.copy_world().Read(0).position.x(), 4);
}

}  // namespace corrector_way_test
}  // namespace seam
