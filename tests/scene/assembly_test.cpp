/// Welded assemblies and jointed mechanisms, and their masses.

#include "common/scene/assembly.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/scene/mass.h"

namespace seam {
namespace assembly_test {

/// A part of unit density.
std::string Box(const char* name, double width, double height, double x, double y,
                const char* more = "") {
  return std::string("[[part]]\nname = \"") + name + "\"\nbox = [" + std::to_string(width) + ", " +
         std::to_string(height) + "]\nposition = [" + std::to_string(x) + ", " + std::to_string(y) +
         "]\n" + more + "\n";
}

std::string Join(const char* kind, const char* a, const char* b) {
  return std::string("[[joint]]\nname = \"") + a + "-" + b + "\"\nkind = \"" + kind + "\"\na = \"" +
         a + "\"\nb = \"" + b + "\"\n";
}

Scene Parse(const std::string& text) { return ParseScene(text, "test.toml"); }

TEST(Assembly, RootIsTheHeaviestPartAndTheLowestOfEquals) {
  const Composition c =
      Compose(Parse(Box("a", 1, 1, 0, 0) + Box("b", 2, 1, 2, 0) + Box("c", 1, 2, 4, 0) +
                    Join("weld", "a", "b") + Join("weld", "c", "b")));
  ASSERT_EQ(c.assemblies.size(), 1u);
  EXPECT_EQ(c.assemblies[0].id, 1);  // b and c weigh the same
  EXPECT_EQ(c.assemblies[0].parts, (std::vector<PartId>{0, 1, 2}));
  EXPECT_EQ(c.assembly_of_part, (std::vector<int>{0, 0, 0}));
}

TEST(Assembly, AssembliesAndMechanismsAscendById) {
  // Part 4 is welded to 0 and heavier: the assembly of part 0 has the greatest id.
  const Composition c =
      Compose(Parse(Box("p0", 1, 1, 0, 0) + Box("p1", 1, 1, 5, 0) + Box("p2", 1, 1, 10, 0) +
                    Box("p3", 1, 1, 15, 0) + Box("p4", 2, 2, 1, 0) + Join("weld", "p0", "p4") +
                    Join("revolute", "p4", "p2")));
  ASSERT_EQ(c.assemblies.size(), 4u);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_LT(c.assemblies[i - 1].id, c.assemblies[i].id);
  EXPECT_EQ(c.assemblies[3].id, 4);
  EXPECT_EQ(c.assembly_of_part, (std::vector<int>{3, 0, 1, 2, 3}));
  ASSERT_EQ(c.mechanisms.size(), 3u);
  EXPECT_EQ(c.mechanisms[0].id, 1);
  EXPECT_EQ(c.mechanisms[1].id, 2);
  EXPECT_EQ(c.mechanisms[1].assemblies, (std::vector<int>{1, 3}));
  EXPECT_EQ(c.mechanisms[2].id, 3);
  EXPECT_EQ(c.assemblies[3].mechanism, 1);
}

TEST(Assembly, WeldsCarryAnchorsAndAnchorsSeparateMechanisms) {
  const Composition c = Compose(
      Parse(Box("post", 1, 1, 0, 0, "anchored = true") + Box("arm", 3, 1, 2, 0) +
            Box("left", 1, 1, 4, 0) + Box("right", 1, 1, 4, 2) + Join("weld", "post", "arm") +
            Join("revolute", "arm", "left") + Join("revolute", "arm", "right")));
  ASSERT_EQ(c.assemblies.size(), 3u);
  EXPECT_TRUE(c.assemblies[0].anchored);
  EXPECT_EQ(c.assemblies[0].id, 1);  // the arm is heavier than the anchored post
  EXPECT_EQ(c.assemblies[0].mechanism, -1);
  ASSERT_EQ(c.mechanisms.size(), 2u);  // both hang from the arm, yet are two
  EXPECT_EQ(c.mechanisms[0].assemblies, std::vector<int>{1});
  EXPECT_EQ(c.mechanisms[1].assemblies, std::vector<int>{2});
}

TEST(Assembly, MechanismBelongsToTheOwnerOfAnyOfItsParts) {
  const std::string players = "[[player]]\nname = \"ann\"\n[[player]]\nname = \"bob\"\n";
  const std::string parts = Box("car", 3, 1, 0, 1) + Box("cart", 1, 1, 3, 1, "owner = \"bob\"") +
                            Box("stone", 1, 1, 9, 1);
  const Composition c = Compose(Parse(players + parts + Join("revolute", "car", "cart")));
  ASSERT_EQ(c.mechanisms.size(), 2u);
  EXPECT_EQ(c.mechanisms[0].owner, 1);
  EXPECT_EQ(c.mechanisms[1].owner, -1);
}

TEST(Assembly, HashDistinguishesCompositions) {
  const std::string base = Box("a", 1, 1, 0, 0) + Box("b", 1, 1, 2, 0) + Box("c", 1, 1, 4, 0);
  const std::uint64_t loose = Compose(Parse(base)).hash;
  EXPECT_EQ(Compose(Parse(base)).hash, loose);
  EXPECT_EQ(Compose(Parse("gravity = [0, -9]\n" + base)).hash, loose);
  const std::uint64_t welded = Compose(Parse(base + Join("weld", "a", "b"))).hash;
  const std::uint64_t hinged = Compose(Parse(base + Join("revolute", "a", "b"))).hash;
  const std::uint64_t other = Compose(Parse(base + Join("weld", "a", "c"))).hash;
  const std::uint64_t owned =
      Compose(Parse("[[player]]\nname = \"ann\"\n" + Box("a", 1, 1, 0, 0, "owner = \"ann\"") +
                    Box("b", 1, 1, 2, 0) + Box("c", 1, 1, 4, 0)))
          .hash;
  const std::vector<std::uint64_t> all = {loose, welded, hinged, other, owned};
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(all[i], all[k]) << i << " " << k;
  }
}

TEST(Mass, WeldedHalvesWeighAndTurnLikeTheWhole) {
  // A 4 x 2 box and the same cut in two, turned by 30 degrees as a whole.
  const double c = std::cos(0.5), s = std::sin(0.5);
  const std::string turned = "angle = 0.5\ndensity = 3";
  const Scene halves = Parse(Box("a", 2, 2, 5 - c, 5 - s, turned.c_str()) +
                             Box("b", 2, 2, 5 + c, 5 + s, turned.c_str()) + Join("weld", "a", "b"));
  const MassProperties cut = AssemblyProperties(halves, Compose(halves).assemblies[0]);
  EXPECT_NEAR(cut.mass, 24, 1e-9);
  EXPECT_NEAR(cut.centre.x(), 1, 1e-6);  // in the root's frame; the text has six decimals
  EXPECT_NEAR(cut.centre.y(), 0, 1e-6);
  EXPECT_NEAR(cut.inertia, 24 * (16 + 4) / 12.0, 1e-4);
}

TEST(Mass, PolygonsAgreeWithBoxesAndTriangles) {
  Part part;
  part.kind = ShapeKind::kPolygon;
  part.material.density = 2;
  part.points = {{1, 1}, {4, 1}, {4, 3}, {1, 3}};
  for (int i = 0; i < 2; ++i) {
    const MassProperties box = PartProperties(part);
    EXPECT_NEAR(box.mass, 12, 1e-12);
    EXPECT_NEAR((box.centre - Eigen::Vector2d(2.5, 2)).norm(), 0, 1e-12);
    EXPECT_NEAR(box.inertia, 12 * (9 + 4) / 12.0, 1e-12);
    std::reverse(part.points.begin(), part.points.end());  // clockwise is as good
  }
  part.points = {{0, 0}, {3, 0}, {0, 3}};
  const MassProperties triangle = PartProperties(part);
  EXPECT_NEAR(triangle.mass, 9, 1e-12);
  EXPECT_NEAR((triangle.centre - Eigen::Vector2d(1, 1)).norm(), 0, 1e-12);
  EXPECT_NEAR(triangle.inertia, 9 * (9 + 9) / 18.0, 1e-12);  // right triangle: m (a^2 + b^2)/18
  part.kind = ShapeKind::kCircle;
  part.radius = 2;
  EXPECT_NEAR(PartProperties(part).mass, 8 * 3.141592653589793, 1e-12);
  EXPECT_NEAR(PartProperties(part).inertia, 16 * 3.141592653589793, 1e-12);
  part.kind = ShapeKind::kChain;
  EXPECT_NEAR(PartProperties(part).mass, (3 + std::sqrt(18.0)) * 0.02 * 2, 1e-6)
      << "a strip of 2 cm";
  part.anchored = true;
  EXPECT_EQ(PartMass(part), 0);
}

}  // namespace assembly_test
}  // namespace seam
