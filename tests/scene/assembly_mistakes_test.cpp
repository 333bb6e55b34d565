/// Mistakes in a scene's connectors, bonds between copies, faces and grouping.

#include <gtest/gtest.h>

#include "common/base/check.h"
#include "common/scene/scene.h"

namespace seam {
namespace assembly_mistakes_test {

std::string Complaint(const std::string& text) {
  try {
    ParseScene(text, "s.toml");
  } catch (const OperatorError& e) {
    return e.what();
  }
  return "";
}

std::string Box(const std::string& lines) {
  return "[[part]]\nname = \"p\"\nbox = [1, 1]\n" + lines + "\n";
}

TEST(AssemblyMistakes, AreNamedByFileLineAndReason) {
  const std::pair<std::string, std::string> mistakes[] = {
      {Box("inlets = [[0, 0]]"), "s.toml:4: part 'p': inlets must be a list of at most 16"},
      {Box("inlets = [1]"), "s.toml:4: part 'p': inlets must be a list"},
      {Box("outlets = [[0, 0, \"x\"]]"), "s.toml:4: part 'p': outlets: each of x, y and angle"},
      {Box("outlets = [[0, 2000, 0]]"), "from -1000 to 1000"},
      {Box("join_strength = 5"), "s.toml:4: part 'p': only connectors join"},
      {Box("inlets = [[0, 0, 0]]\njoin_reach = 0"), "s.toml:5: part 'p': join_reach must be"},
      {Box("inlets = [[0, 0, 0]]\njoin_angle = 4"), "join_angle must be"},
      {Box("repeat = {count = 2, step = [1, 0], weld = true, glue = 3}"), "both weld and glue"},
      {Box("repeat = {count = 2, step = [1, 0], glue = -3}"), "glue must be"},
      {Box("repeat = {count = [182, 182], step = [1, 1], glue = 3}"), "at most 65535 joints"},
      {Box("repeat = {count = 2, step = [1, 0]}") +
           "[[joint]]\nname = \"j\"\nkind = \"weld\"\na = \"p.0\"\nb = \"p.1\"\n"
           "repeat = {count = 1, step = [1, 0], weld = true}\n",
       "only parts are welded or glued"},
      {Box("") + "[grouping]\n", "after is missing"},
      {Box("") + "[grouping]\nafter = 0\n", "after must be"},
      {Box("") + "[grouping]\nafter = 1\nimpact = -1\n", "impact must be"},
      {Box("") + "[grouping]\nafter = 1\nacceleration = -1\n", "acceleration must be"},
      {Box("") + "[grouping]\nafter = 1\nspin = 101\n", "spin must be"},
      {"[solver]\nfaces = \"none\"\n" + Box(""), "s.toml:2: solver: faces must be"},
  };
  for (const auto& [text, says] : mistakes) {
    EXPECT_NE(Complaint(text).find(says), std::string::npos) << text << Complaint(text);
  }
  EXPECT_EQ(Complaint(Box("inlets = [[0, 0, 0]]\nrepeat = {count = [3, 2], step = [1, 1], "
                          "glue = 3}") +
                      "[grouping]\nafter = 1\n"),
            "");
}

TEST(AssemblyMistakes, CopiesAreJoinedWithTheirNeighbours) {
  const Scene scene =
      ParseScene(Box("repeat = {count = [3, 2], step = [1, 1], glue = 7}"), "s.toml");
  ASSERT_EQ(scene.joints.size(), 2u * 2 + 3u * 1);
  for (const Joint& joint : scene.joints) {
    const Vec2 apart = scene.parts[static_cast<std::size_t>(joint.b)].position -
                       scene.parts[static_cast<std::size_t>(joint.a)].position;
    EXPECT_FLOAT_EQ(apart.norm(), 1) << joint.name;
    EXPECT_EQ(joint.strength, 7);
  }
  EXPECT_EQ(scene.joints.front().name, "p.h.0.0");
}

}  // namespace assembly_mistakes_test
}  // namespace seam
