/// Many aligned boxes as few rectangles.

#include "common/physics/faces.h"

#include <gtest/gtest.h>

#include "tests/support/small_world.h"

namespace seam {
namespace faces_test {

std::vector<Face> FacesIn(const std::string& parts, const std::string& solver = "") {
  const auto world = SmallWorld(parts, solver);
  return FacesOf(world->scene(), world->composition().assemblies.front());
}

std::string Sheet(int columns, int rows, const std::string& more = "") {
  return "[[part]]\nname = \"cell\"\nbox = [0.5, 0.25]\nposition = [3, 2]\n" + more +
         "\nrepeat = {count = [" + std::to_string(columns) + ", " + std::to_string(rows) +
         "], step = [0.5, 0.25], weld = true}\n";
}

TEST(Faces, ASheetIsOneRectangleOfItsSize) {
  const std::vector<Face> faces = FacesIn(Sheet(40, 25));
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_EQ(faces[0].parts.size(), 1000u);
  EXPECT_NEAR(faces[0].shape.size.x(), 20, 1e-4);
  EXPECT_NEAR(faces[0].shape.size.y(), 6.25, 1e-4);
  EXPECT_NEAR(faces[0].shape.position.x(), 3 + 39 * 0.25, 1e-4);
  EXPECT_NEAR(faces[0].shape.position.y(), 2 + 24 * 0.125, 1e-4);
}

TEST(Faces, AStepMakesTwoAndOtherFrictionStaysApart) {
  const std::string upper =
      "[[part]]\nname = \"upper\"\nbox = [0.5, 0.25]\nposition = [3, 3]\n"
      "repeat = {count = [4, 2], step = [0.5, 0.25], weld = true}\n"
      "[[joint]]\nname = \"seam\"\nkind = \"weld\"\na = \"cell.0.3\"\nb = \"upper.0.0\"\n";
  EXPECT_EQ(FacesIn(Sheet(10, 4) + upper).size(), 2u);
  EXPECT_EQ(FacesIn(Sheet(4, 4) + upper).size(), 1u) << "as wide: one tall rectangle";
  const std::string slippery =
      "[[part]]\nname = \"ice\"\nbox = [0.5, 0.25]\nfriction = 0\n"
      "position = [3, 3]\n[[joint]]\nname = \"seam\"\nkind = \"weld\"\n"
      "a = \"cell.0.3\"\nb = \"ice\"\n";
  EXPECT_EQ(FacesIn(Sheet(4, 4) + slippery).size(), 2u);
}

TEST(Faces, SmallAssembliesAndASceneSettingKeepEachPart) {
  EXPECT_EQ(FacesIn(Sheet(7, 1)).size(), 7u);
  EXPECT_EQ(FacesIn(Sheet(8, 1)).size(), 1u);
  EXPECT_EQ(FacesIn(Sheet(10, 4), "faces = \"all\"").size(), 40u);
  EXPECT_EQ(FacesIn(Sheet(10, 4), "faces = \"outer\"").size(), 40u - 8 * 2);
}

TEST(Faces, ThePartAtAPointIsTheOneThatIsThere) {
  const auto world = SmallWorld(Sheet(10, 4));
  const Face face = FacesOf(world->scene(), world->composition().assemblies.front()).front();
  const Part& part = world->scene().parts[17];
  EXPECT_EQ(NearestPart(world->scene(), face.parts, part.position.cast<double>()), 17);
  // Outside, nearest to the upper right corner: the last one.
  EXPECT_EQ(NearestPart(world->scene(), face.parts, {9, 9}), 39);
}

TEST(Faces, MergedPartsFallAndRestAsTheyDoOneByOne) {
  const std::string ground = "[[part]]\nname = \"ground\"\nchain = [[-20, 0], [20, 0]]\n";
  auto merged = SmallWorld(Sheet(8, 3, "angle = 0") + ground);
  auto each = SmallWorld(Sheet(8, 3, "angle = 0") + ground, "faces = \"all\"");
  Steps(merged.get(), 240);
  Steps(each.get(), 240);
  EXPECT_NEAR((merged->Read(0).position - each->Read(0).position).norm(), 0, 0.01);
  EXPECT_FLOAT_EQ(merged->mass(0), each->mass(0));
}

}  // namespace faces_test
}  // namespace seam
