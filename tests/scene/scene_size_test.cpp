/// The largest valid scenes, and scenes one larger.

#include <gtest/gtest.h>

#include <chrono>

#include "common/base/check.h"
#include "common/physics/world.h"
#include "common/scene/scene.h"
#include "common/scene/scene_limits.h"

namespace seam {
namespace scene_size_test {

/// Returns the error of a scene; "" if it is valid.
std::string WhatIsWrong(const std::string& text) {
  try {
    ParseScene(text, "x.toml");
  } catch (const OperatorError& error) {
    return error.what();
  }
  return "";
}

std::string Players(int count) {
  return "[[part]]\nname = \"ball\"\ncircle = 1\n[[player]]\nname = \"p\"\nrepeat = {count = " +
         std::to_string(count) + "}\n";
}

/// So many boxes in rows that do not touch, in thin air.
std::string Boxes(int columns, int rows) {
  return "bounds = [[-10, -10], [29000, 29000]]\n[[part]]\nname = \"box\"\nbox = [0.5, "
         "0.5]\nrepeat "
         "= {count = [" +
         std::to_string(columns) + ", " + std::to_string(rows) + "], step = [1, 1]}\n";
}

TEST(SceneSize, Has1000PlayersAndNotOneMore) {
  EXPECT_EQ(ParseScene(Players(1000), "full.toml").players.size(), 1000u);
  EXPECT_NE(WhatIsWrong(Players(1001)).find("at most 1000 players"), std::string::npos);
  const std::string another = Players(1000) + "[[player]]\nname = \"ann\"\n";
  EXPECT_NE(WhatIsWrong(another).find("at most 1000 players"), std::string::npos);
}

TEST(SceneSize, ARoomOfMoreThan256PlayersIsNeverFollowedWhole) {
  EXPECT_EQ(ParseScene(Players(256), "whole.toml").follow_bodies, 256);
  EXPECT_EQ(ParseScene(Players(257), "large.toml").follow_bodies, 0);
  EXPECT_EQ(ParseScene("follow = 0\n" + Players(257), "large.toml").follow_bodies, 0);
  EXPECT_EQ(WhatIsWrong("follow = 9\n" + Players(256)), "");
  EXPECT_EQ(WhatIsWrong("follow = 9\n" + Players(257)),
            "x.toml:1: scene: follow must be 0 in a scene of more than 256 players");
}

TEST(SceneSize, Has65535PartsAndNotOneMore) {
  const Scene scene = ParseScene(Boxes(4369, 15), "full.toml");
  ASSERT_EQ(scene.parts.size(), kPartsMax);
  EXPECT_EQ(scene.parts.back().name, "box.4368.14");
  const std::string another =
      Boxes(4369, 15) + "[[part]]\nname = \"more\"\nbox = [1, 1]\nposition = [-5, -5]\n";
  EXPECT_NE(WhatIsWrong(another).find("at most 65535 parts"), std::string::npos);
}

TEST(SceneSize, Has65407JointsButNot65662) {
  // In a closed grid of c columns and r rows there are (c - 1) r + c (r - 1) bonds.
  const auto glued = [](int columns, int rows) {
    std::string text = Boxes(columns, rows);
    text.insert(text.rfind('}'), ", glue = 5");
    return text;
  };
  ASSERT_EQ(ParseScene(glued(3, 2), "few.toml").joints.size(), 7u);
  EXPECT_EQ(ParseScene(glued(257, 128), "x.toml").joints.size(), 65407u);
  EXPECT_NE(WhatIsWrong(glued(258, 128)).find("65535 joints"), std::string::npos);
}

TEST(SceneSize, WithAllItsPartsItIsReadAndBuiltInSeconds) {
  const auto begin = std::chrono::steady_clock::now();
  const Scene scene = ParseScene(Boxes(4369, 15), "full.toml");
  World world(scene);
  ASSERT_EQ(world.body_count(), static_cast<int>(kPartsMax));
  world.Step();
  EXPECT_EQ(world.id(world.body_count() - 1), 65534);
  EXPECT_EQ(world.BodyOfId(65534), world.body_count() - 1);
  EXPECT_LT(world.Read(world.body_count() - 1).velocity.y(), 0) << "it falls";
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(took.count(), 20) << "what is quadratic takes minutes";
}

}  // namespace scene_size_test
}  // namespace seam
