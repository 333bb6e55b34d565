/// Mistakes in a scene's gears and pulleys.

#include <gtest/gtest.h>

#include "common/base/check.h"
#include "common/scene/scene.h"

namespace seam {
namespace coupling_mistakes_test {

const std::string kParts =
    "[[part]]\nname = \"post\"\nbox = [1, 1]\nanchored = true\n"
    "[[part]]\nname = \"p\"\nbox = [1, 1]\nposition = [2, 0]\nrepeat = {count = 2, step = [2, 0]}\n"
    "[[joint]]\nname = \"h\"\nkind = \"hinge\"\na = \"post\"\nb = \"p.0\"\n"
    "[[joint]]\nname = \"s\"\nkind = \"prismatic\"\na = \"post\"\nb = \"p.1\"\n"
    "[[joint]]\nname = \"w\"\nkind = \"wheel\"\na = \"post\"\nb = \"p.1\"\n"
    "[[joint]]\nname = \"back\"\nkind = \"hinge\"\na = \"p.0\"\nb = \"post\"\n";

std::string Complaint(const std::string& joint) {
  try {
    ParseScene(kParts + "[[joint]]\nname = \"j\"\n" + joint + "\n", "s.toml");
  } catch (const OperatorError& e) {
    return e.what();
  }
  return "";
}

std::string Gear(const std::string& rest) { return "kind = \"gear\"\n" + rest; }

std::string Pulley(const std::string& rest) {
  return "kind = \"pulley\"\na = \"p.0\"\nb = \"p.1\"\n" + rest;
}

const std::string kGrounds = "ground_a = [2, 5]\nground_b = [4, 5]\n";

TEST(CouplingMistakes, AreNamedByFileLineAndReason) {
  const std::pair<std::string, std::string> mistakes[] = {
      {Gear(""), "s.toml:30: joint 'j': joints must be the names of two joints"},
      {Gear("joints = [\"h\"]"), "s.toml:33: joint 'j': joints must be the names of two joints"},
      {Gear("joints = [\"h\", \"x\"]"), "there is no joint 'x' above it"},
      {Gear("joints = [\"h\", \"j\"]"), "there is no joint 'j' above it"},
      {Gear("joints = [\"h\", \"w\"]"), "'w' is neither a hinge nor prismatic"},
      {Gear("joints = [\"h\", \"h\"]"), "joins a part with itself"},
      {Gear("joints = [\"h\", \"s\"]\nratio = 0"), "the ratio is too close to 0"},
      {Gear("joints = [\"h\", \"s\"]\nratio = 1001"), "ratio must be a number from -1000 to 1000"},
      {Gear("joints = [\"h\", \"s\"]\na = \"p.0\""), "a gear joint has no a"},
      {Gear("joints = [\"h\", \"s\"]\nb = \"p.0\""), "a gear joint has no b"},
      {Gear("joints = [\"h\", \"s\"]\nlocal_a = [0, 0]"), "a gear joint has no local_a"},
      {Gear("joints = [\"h\", \"s\"]\nrepeat = {count = 2, step = [1, 0]}"),
       "a gear joint has no repeat"},
      {Gear("joints = [\"h\", \"back\"]"), "it turns 'post', which is anchored"},
      {Pulley("ground_a = [2, 5]"), "ground_b is missing"},
      {Pulley(kGrounds + "ratio = -1"), "ratio must be a number from 0 to 1000"},
      {Pulley(kGrounds + "ratio = 0"), "the ratio is too close to 0"},
      {Pulley("ground_a = [2, 0.05]\nground_b = [4, 5]"), "is closer than 0.1 m"},
      {Pulley(kGrounds + "limits = [1, 2]"), "a pulley joint has no limits"},
      {Pulley(kGrounds + "length = 0"), "length must be a number from 0.02"},
  };
  for (const auto& [text, says] : mistakes) {
    EXPECT_NE(Complaint(text).find(says), std::string::npos) << text << "\n" << Complaint(text);
  }
  EXPECT_EQ(Complaint(Gear("joints = [\"h\", \"s\"]\nratio = -0.5\ncollide = true")), "");
  EXPECT_EQ(Complaint(Pulley(kGrounds + "ratio = 3\nlength = 9\nanchor_a = [2, 0.5]")), "");
}

TEST(CouplingMistakes, CopiesOfAPulleyHaveTheirOwnGround) {
  const Scene scene = ParseScene(
      "[[part]]\nname = \"p\"\nbox = [1, 1]\nrepeat = {count = 4, step = [2, 0]}\n"
      "[[joint]]\nname = \"j\"\nkind = \"pulley\"\na = \"p.0\"\nb = \"p.1\"\n"
      "ground_a = [0, 5]\nground_b = [2, 5]\nrepeat = {count = 2, step = [2, 0]}\n",
      "s.toml");
  ASSERT_EQ(scene.joints.size(), 2u);
  EXPECT_EQ(scene.joints[1].ground_a, Vec2(2, 5));
  EXPECT_EQ(scene.joints[1].ground_b, Vec2(4, 5));
  EXPECT_EQ(scene.joints[1].a, 1);
  EXPECT_EQ(scene.joints[1].length, scene.joints[0].length);
}

}  // namespace coupling_mistakes_test
}  // namespace seam
