/// Settings written into a scene's text: the scene gets the value, and everything else stays
/// unchanged.

#include <gtest/gtest.h>

#include "common/base/check.h"
#include "tests/lab/scene_settings.h"

namespace seam {
namespace lab_settings_test {

const char* const kText = R"(title = "Set me"
buffer = 10     # metres
[solver]
substeps = 2    # not buffer = 3
[[part]]
name = "ground"
chain = [
  [-10, 0],
  [10, 0]]
[[part]]
name = "box"
box = [1, 1]
density = 2
)";

std::string With(const std::string& settings, const std::string& text = kText) {
  return WithSettings(text, SplitSettings(settings), "test.toml");
}

TEST(SceneSettings, ReplaceALineOrAddOne) {
  std::string wanted = kText;
  wanted.replace(wanted.find("buffer = 10     # metres"), 24, "buffer = 5");
  EXPECT_EQ(With("buffer=5"), wanted);
  EXPECT_EQ(With(" buffer = 5 "), wanted);
  wanted = kText;
  wanted.replace(wanted.find("substeps = 2    # not buffer = 3"), 32, "substeps = 4");
  EXPECT_EQ(With("solver.substeps=4"), wanted);
  wanted = kText;
  wanted.insert(wanted.find("substeps"), "skin = 0.0025\n");
  EXPECT_EQ(With("solver.skin=0.0025"), wanted);
  EXPECT_EQ(With("gravity=[0, -9]"), std::string("gravity = [0, -9]\n") + kText);
  EXPECT_EQ(With("camera.min=[0, 0]"), std::string(kText) + "[camera]\nmin = [0, 0]\n");
  EXPECT_EQ(With(""), kText);
}

TEST(SceneSettings, AreAppliedToTheScene) {
  const Scene scene = ParseScene(With("buffer=2.5;solver.substeps=3;solver.sleep=false;"
                                      "solver.welds=\"joint\";solver.velocity_iterations=1"),
                                 "test.toml");
  EXPECT_EQ(scene.buffer_m, 2.5f);
  EXPECT_EQ(scene.solver.substeps, 3);
  EXPECT_EQ(scene.solver.velocity_iterations, 1);
  EXPECT_FALSE(scene.solver.sleep);
  EXPECT_TRUE(scene.solver.weld_joints);
  EXPECT_EQ(scene.parts.size(), 2u);
  EXPECT_EQ(scene.parts[1].material.density, 2);
  EXPECT_EQ(
      ParseScene(With("solver.tick_hz=240", "[[part]]\nname = \"a\"\nbox = [1, 1]"), "test.toml")
          .solver.tick_hz,
      240);
}

TEST(SceneSettings, AreTheSameInAnyOrderOfTwoAndCanBeSetAgain) {
  EXPECT_EQ(With("buffer=5;solver.substeps=4"), With("solver.substeps=4;buffer=5"));
  EXPECT_EQ(With("buffer=5", With("buffer=7")), With("buffer=5"));
  EXPECT_EQ(JoinSettings(SplitSettings(" buffer = 5 ; solver.substeps=4")),
            "buffer=5;solver.substeps=4");
}

TEST(SceneSettings, AreRefusedWhenMeaningless) {
  for (const char* settings :
       {"buffer", "=5", "buffer=", "buffer=five", "buffer=5;buffer=6", ";", "a.b.c=1", "Buffer=5",
        "buffer=5 # more", "buffer=[", "buffer=5\nsolver = 3", "solver.=1", ".x=1"}) {
    EXPECT_THROW(With(settings), OperatorError) << settings;
  }
  for (const char* settings : {"solver.magic=1", "magic=1", "buffer=\"5\"", "solver.substeps=99",
                               "solver.substeps=1.5", "part.density=1"}) {
    EXPECT_THROW(LoadSceneWith("scenes/crossing.toml", {settings}), OperatorError) << settings;
  }
  // Written in a way that no line stands for.
  EXPECT_THROW(With("solver.substeps=4", "solver = {substeps = 2}\n"), OperatorError);
  EXPECT_THROW(With("solver.substeps=4", "solver.substeps = 2\n"), OperatorError);
}

}  // namespace lab_settings_test
}  // namespace seam
