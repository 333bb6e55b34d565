/// Featherweight bricks as data: memory, cells, and outlines of the solid area.

#include "common/topology/feather_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "common/base/random.h"
#include "common/scene/bricks.h"
#include "common/stages/bricks/feather_outline.h"
#include "tests/support/soak.h"

namespace seam {
namespace feather_store_test {

BrickField Rectangle(int x, int y, int columns, int rows, int width = 10, int height = 5) {
  BrickField field;
  field.name = "f";
  field.width = width;
  field.height = height;
  field.x = x;
  field.y = y;
  field.columns = columns;
  field.rows = rows;
  return field;
}

BrickField Towers(int count, bool windows) {
  BrickField field = Rectangle(-4000, 0, 0, 0);
  field.towers = {count, 400, 16, 28, 80, 190, windows, 7};
  return field;
}

using Square = std::pair<int, int>;

/// Unit squares of a set of bricks.
std::set<Square> Squares(const FeatherStore& store) {
  std::set<Square> squares;
  std::vector<Brick> bricks;
  for (int cell = 0; cell < store.cell_count(); ++cell) store.Append(cell, &bricks);
  for (const Brick& b : bricks) {
    const BrickKind& kind = store.kinds()[static_cast<std::size_t>(b.kind)];
    for (int x = b.x; x < b.x + kind.width; ++x) {
      for (int y = b.y; y < b.y + kind.height; ++y) squares.insert({x, y});
    }
  }
  return squares;
}

/// A side of one unit with its way: solid on the left.
using UnitSide = std::tuple<int, int, int, int>;

std::multiset<UnitSide> SidesOf(const std::set<Square>& solid) {
  std::multiset<UnitSide> sides;
  for (const auto& [x, y] : solid) {
    if (solid.count({x, y - 1}) == 0) sides.insert({x, y, x + 1, y});
    if (solid.count({x + 1, y}) == 0) sides.insert({x + 1, y, x + 1, y + 1});
    if (solid.count({x, y + 1}) == 0) sides.insert({x + 1, y + 1, x, y + 1});
    if (solid.count({x - 1, y}) == 0) sides.insert({x, y + 1, x, y});
  }
  return sides;
}

std::vector<OutlinePath> AllOutlines(const FeatherStore& store) {
  std::vector<OutlinePath> all;
  for (int cell = 0; cell < store.cell_count(); ++cell) {
    for (OutlinePath& path : OutlinesOf(store, store.cell_x(cell), store.cell_y(cell))) {
      all.push_back(std::move(path));
    }
  }
  return all;
}

std::multiset<UnitSide> SidesOf(const std::vector<OutlinePath>& paths) {
  std::multiset<UnitSide> sides;
  for (const OutlinePath& path : paths) {
    const std::size_t count = path.corners.size();
    for (std::size_t i = 0; i + (path.closed ? 0 : 1) < count; ++i) {
      const auto& from = path.corners[i];
      const auto& to = path.corners[(i + 1) % count];
      const int dx = (to.x > from.x) - (to.x < from.x), dy = (to.y > from.y) - (to.y < from.y);
      EXPECT_EQ(std::abs(dx) + std::abs(dy), 1) << "along an axis";
      for (int x = from.x, y = from.y; x != to.x || y != to.y; x += dx, y += dy) {
        sides.insert({x, y, x + dx, y + dy});
      }
    }
  }
  return sides;
}

TEST(FeatherStore, AMillionBricksTakeLessThanFiveBytesEach) {
  const std::vector<BrickField> fields = {Towers(420, true),
                                          Rectangle(-4000, -20, 20000, 1, 20, 20)};
  const FeatherStore store(fields);
  EXPECT_GT(store.size(), 900000u);
  const double each = static_cast<double>(store.bytes()) / static_cast<double>(store.size());
  EXPECT_LT(each, 5);
  EXPECT_GT(each, 4);
}

TEST(FeatherStore, FindsExactlyTheBricksInABox) {
  const FeatherStore store({Rectangle(-400, -90, 90, 50, 9, 7), Rectangle(0, 300, 20, 9, 80, 31)});
  std::vector<Brick> all;
  for (int cell = 0; cell < store.cell_count(); ++cell) store.Append(cell, &all);
  ASSERT_EQ(all.size(), 90u * 50 + 180);
  ASSERT_EQ(all.size(), store.size());
  Random random(5);
  for (int trial = 0; trial < 200; ++trial) {
    const int x0 = static_cast<int>(random.Uniform(-600, 1800)), x1 = x0 + 1 + trial * 2;
    const int y0 = static_cast<int>(random.Uniform(-200, 700)), y1 = y0 + 1 + trial;
    std::size_t expected = 0;
    for (const Brick& b : all) {
      const BrickKind& k = store.kinds()[static_cast<std::size_t>(b.kind)];
      if (b.x < x1 && b.x + k.width > x0 && b.y < y1 && b.y + k.height > y0) ++expected;
    }
    ASSERT_EQ(store.InBox(x0, y0, x1, y1).size(), expected) << trial;
  }
}

TEST(FeatherStore, RestoringRemovedBricksRestoresTheStore) {
  FeatherStore store({Rectangle(-400, -90, 90, 50, 9, 7)});
  const FeatherStore before = store;
  std::vector<Brick> hole = store.InBox(-50, -20, 120, 90);
  ASSERT_GT(hole.size(), 100u);
  EXPECT_EQ(store.Remove(hole), hole.size());
  EXPECT_EQ(store.Remove(hole), 0u) << "they are gone";
  EXPECT_TRUE(store.InBox(-50, -20, 120, 90).empty());
  std::reverse(hole.begin(), hole.end());
  store.Restore(hole);
  for (int cell = 0; cell < store.cell_count(); ++cell) {
    std::vector<Brick> now, then;
    store.Append(cell, &now);
    before.Append(cell, &then);
    EXPECT_EQ(now, then) << cell;
  }
}

TEST(FeatherOutline, AWallOverManyCellsHasOneLinePerCellAndNoInnerEdge) {
  // 100 m of wall, 13 cells: 26 lines along it, and its two ends.
  const FeatherStore store({Rectangle(0, 20, 200, 8)});
  int lines = 0, corners = 0;
  for (const OutlinePath& path : AllOutlines(store)) {
    EXPECT_FALSE(path.closed);
    ++lines;
    corners += static_cast<int>(path.corners.size());
    for (const auto& c : path.corners) {
      const bool end = c.x == 0 || c.x == 2000;
      EXPECT_EQ(c.before != c.after, end) << c.x << ": straight on over the cells' borders";
    }
  }
  EXPECT_EQ(lines, 24) << "the first and the last cell have one each that goes around the end";
  EXPECT_EQ(corners, 24 * 2 + 4);
}

TEST(FeatherOutline, AllCellsTogetherAreTheBoundaryOfTheUnion) {
  for (const int seed : SoakSeeds(0, 40)) {
    Random random(static_cast<std::uint64_t>(seed));
    std::vector<BrickField> fields;
    for (int i = 0; i < 12; ++i) {  // also overlapping, touching at corners, reaching over borders
      const auto in = [&](int low, int high) {
        return low + static_cast<int>(random.Next() % static_cast<std::uint64_t>(high - low));
      };
      fields.push_back(
          Rectangle(in(-190, 150), in(-190, 150), in(1, 6), in(1, 6), in(2, 40), in(2, 40)));
      fields.back().friction = seed % 2 == 0 ? 0.5f : static_cast<float>(i % 3) / 4;
    }
    const FeatherStore store(fields);
    ASSERT_EQ(SidesOf(AllOutlines(store)), SidesOf(Squares(store))) << "seed " << seed;
  }
}

TEST(FeatherOutline, OpenPathsContinueIntoTheNext) {
  BrickField rough = Rectangle(-300, 100, 3, 9);
  rough.friction = 0.9f;
  const FeatherStore store({Towers(2, true), Rectangle(-500, -40, 90, 8), rough});
  std::map<std::tuple<int, int, int, int>, int> ends;  // corner and way: begun minus ended
  int open = 0;
  for (const OutlinePath& path : AllOutlines(store)) {
    if (path.closed) continue;
    ++open;
    const auto &first = path.corners.front(), &last = path.corners.back();
    ++ends[{first.x, first.y, first.before, first.after}];
    --ends[{last.x, last.y, last.before, last.after}];
  }
  EXPECT_GT(open, 50);
  for (const auto& [corner, sum] : ends) EXPECT_EQ(sum, 0) << std::get<0>(corner);
}

TEST(FeatherOutline, WindowsAreHolesAndTowersDiffer) {
  const FeatherStore with({Towers(20, true)}), without({Towers(20, false)});
  EXPECT_LT(with.size(), without.size() * 95 / 100);
  EXPECT_GT(with.size(), without.size() * 70 / 100);
  int holes = 0;
  for (const OutlinePath& path : AllOutlines(with)) holes += path.closed;
  EXPECT_GT(holes, 300);
  std::set<int> heights;
  for (int tower = 0; tower < 20; ++tower) {
    const int x = -4000 + 400 * tower;
    int top = 0;
    for (const Brick& b : without.InBox(x, 0, x + 300, 4000)) top = std::max(top, b.y + 5);
    heights.insert(top);
    EXPECT_GE(top, 80 * 5);
    EXPECT_LE(top, 190 * 5);
  }
  EXPECT_GT(heights.size(), 10u);
}

}  // namespace feather_store_test
}  // namespace seam
