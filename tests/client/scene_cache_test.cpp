/// SceneCache: equal texts share one scene, and an invalid text is refused as by ParseScene.

#include "client/scene_cache.h"

#include <gtest/gtest.h>

#include "common/base/check.h"

namespace seam {
namespace scene_cache_test {

const char* const kBall = "[[part]]\nname = \"ball\"\ncircle = 0.5\n";

TEST(SceneCache, TheSameTextIsOneSceneWhileAnyoneUsesIt) {
  SceneCache shelf;
  auto one = shelf.Of(kBall, "ball.toml");
  auto other = shelf.Of(kBall, "ball.toml");
  EXPECT_EQ(one, other);
  EXPECT_EQ(one->parts.size(), 1u);
  const std::weak_ptr<const Scene> gone = one;
  one.reset();
  EXPECT_FALSE(gone.expired());
  other.reset();
  EXPECT_TRUE(gone.expired()) << "nobody has it";
  EXPECT_EQ(shelf.Of(kBall, "ball.toml")->parts.size(), 1u);
}

TEST(SceneCache, AnotherTextOrNameIsAnotherScene) {
  SceneCache shelf;
  const auto ball = shelf.Of(kBall, "ball.toml");
  const auto named = shelf.Of(kBall, "disc.toml");
  const auto larger = shelf.Of("[[part]]\nname = \"ball\"\ncircle = 0.7\n", "ball.toml");
  EXPECT_NE(ball, named);
  EXPECT_EQ(named->name, "disc");
  EXPECT_NE(ball, larger);
}

TEST(SceneCache, RefusesAnInvalidSceneEveryTime) {
  SceneCache shelf;
  for (int i = 0; i < 2; ++i) EXPECT_THROW(shelf.Of("[[part]]\n", "x.toml"), OperatorError);
}

}  // namespace scene_cache_test
}  // namespace seam
