/// Anchored parts are dense by what is near and touches, not by how many a scene has.

#include "common/physics/anchored/dense_anchored.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/living_world.h"

namespace seam {
namespace dense_anchored_test {

int CountDense(const std::string& text) {
  const Scene scene = ParseScene(text, "dense.toml");
  const std::vector<bool> dense = DenseAnchored(scene, Compose(scene));
  return static_cast<int>(std::count(dense.begin(), dense.end(), true));
}

/// Anchored boxes of 1 m from (x, y) on, `step` m apart.
std::string Row(const std::string& name, int count, double x, double y, double step) {
  if (count == 0) return "";
  return "[[part]]\nname = \"" + name + "\"\nbox = [1, 1]\nposition = [" + std::to_string(x) +
         ", " + std::to_string(y) +
         "]\nanchored = true\nrepeat = {count = " + std::to_string(count) + ", step = [" +
         std::to_string(step) + ", 0]}\n";
}

TEST(DenseAnchored, CountsPartsThatTouch) {
  EXPECT_EQ(CountDense(Row("row", 31, 0, 0, 1)), 0);
  EXPECT_EQ(CountDense(Row("row", 32, 0, 0, 1)), 32);
  EXPECT_EQ(CountDense(Row("row", 60, 0, 0, 1.2)), 0) << "gaps of 20 cm";
  EXPECT_EQ(CountDense(Row("a", 20, 0, 0, 1) + Row("b", 20, 0, 1, 1)), 40);
  EXPECT_EQ(CountDense(Row("a", 20, 0, 0, 1) + Row("b", 20, 0, 3, 1)), 0);
}

TEST(DenseAnchored, AGroundDoesNotJoinWhatStandsOnIt) {
  const std::string ground =
      "[[part]]\nname = \"ground\"\nbox = [300, 1]\nposition = [0, 0]\nanchored = true\n";
  EXPECT_EQ(CountDense(ground + Row("a", 20, -40, 1, 1) + Row("b", 20, 40, 1, 1)), 0);
}

/// Boxes and discs that fall between two anchored walls; `far` is text after them. Returns the
/// states of the 24 after 4 s.
std::vector<BodyState> Pile(const std::string& far, const std::string& solver) {
  std::string text =
      "[[part]]\nname = \"left\"\nbox = [1, 12]\nposition = [-4, 6]\nanchored = true\nangle = 0.1\n"
      "[[part]]\nname = \"right\"\nbox = [1, 12]\nposition = [5, 6]\nanchored = true\n"
      "[[part]]\nname = \"floor\"\nbox = [200, 1]\nposition = [50, -0.5]\nanchored = true\n";
  for (int i = 0; i < 24; ++i) {
    text += "[[part]]\nname = \"b" + std::to_string(i) + "\"\nrestitution = 0.3\n" +
            (i % 2 == 0 ? "circle = 0.4" : "box = [0.8, 0.8]") + "\nposition = [" +
            std::to_string((i % 6) * 0.83 - 2 + 0.05 * (i * 7 % 5)) + ", " +
            std::to_string(1 + i / 6) + "]\n";
  }
  auto world = SmallWorld(text + far, solver);
  Live(world.get(), 240);
  std::vector<BodyState> states;
  for (int i = 0; i < world->body_count(); ++i) states.push_back(world->Read(i));
  return states;
}

TEST(DenseAnchored, FarBoxesChangeNoBitOfAPile) {
  for (const char* solver : {"", "contacts = \"soft\"\n", "substeps = 3\n"}) {
    const std::vector<BodyState> alone = Pile("", solver);
    ASSERT_EQ(alone.size(), 24u);
    for (const int count : {1, 10, 28, 29, 31, 32, 40, 100}) {
      for (const auto& [y, step] : {std::pair{0.5, 1.0}, {25.0, 1.0}, {25.0, 3.0}}) {
        const std::vector<BodyState> now = Pile(Row("far", count, 60, y, step), solver);
        ASSERT_EQ(now.size(), alone.size());
        for (std::size_t i = 0; i < now.size(); ++i) {
          ASSERT_TRUE(now[i].position == alone[i].position && now[i].angle == alone[i].angle)
              << solver << count << " boxes " << step << " m apart, body " << i;
        }
      }
    }
  }
}

}  // namespace dense_anchored_test
}  // namespace seam
