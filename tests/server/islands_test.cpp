/// Groups of bodies that influence each other, counted.

#include "server/load/islands.h"

#include <gtest/gtest.h>

#include "common/scene/scene.h"

namespace seam {
namespace islands_test {

/// Two crates in a stack, one apart, and two that a rope joins in the air.
constexpr const char* kFive = R"(
[[part]]
name = "ground"
chain = [[-30, 0], [30, 0]]
[[part]]
name = "lower"
box = [1, 1]
position = [-10, 0.5]
[[part]]
name = "upper"
box = [1, 1]
position = [-10, 1.5]
[[part]]
name = "apart"
box = [1, 1]
position = [0, 0.5]
[[part]]
name = "left"
circle = 0.3
position = [8, 20]
[[part]]
name = "right"
circle = 0.3
position = [10, 20]
[[joint]]
name = "rope"
kind = "rope"
a = "left"
b = "right"
length = 3
)";

TEST(Islands, TouchingOrJoinedBodiesAreOneIslandAndSleepersAreNone) {
  World world(ParseScene(kFive, "five"));
  for (int i = 0; i < 10; ++i) world.Step();
  EXPECT_EQ(CountIslands(world), 3) << "the stack, the crate apart, the joined pair";
  for (int i = 0; i < 600; ++i) world.Step();
  for (int body = 0; body < world.body_count(); ++body) world.SetAwake(body, false);
  EXPECT_EQ(CountIslands(world), 0);
}

}  // namespace islands_test
}  // namespace seam
