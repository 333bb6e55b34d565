/// Bricks in pictures: exactly the solid area is drawn.

#include <gtest/gtest.h>

#include "common/scene/bricks.h"
#include "render/draw/draw_bricks.h"
#include "tests/support/render_fixture.h"

namespace seam {
namespace render_bricks_test {

FeatherStore SmallCity() {
  BrickField street;
  street.width = 20;
  street.height = 10;
  street.x = -400;
  street.y = -20;
  street.columns = 40;
  street.rows = 2;
  BrickField towers;
  towers.x = -300;
  towers.towers = {3, 200, 12, 18, 40, 60, true, 5};
  return FeatherStore({street, towers});
}

TEST(DrawBricks, BlocksCoverEachBrickOnceAndAreFew) {
  const FeatherStore store = SmallCity();
  std::size_t bricks = 0, blocks = 0;
  for (int cell = 0; cell < store.cell_count(); ++cell) {
    std::vector<Brick> expected;
    store.Append(cell, &expected);
    std::vector<Brick> covered;
    for (const BrickBlock& b : BlocksOf(store, cell)) {
      ++blocks;
      const BrickKind& kind = store.kinds()[static_cast<std::size_t>(b.kind)];
      for (int row = 0; row < b.rows; ++row) {
        for (int column = 0; column < b.columns; ++column) {
          covered.push_back({b.x + column * kind.width, b.y + row * kind.height, b.kind});
        }
      }
    }
    const auto by_place = [](const Brick& p, const Brick& q) {
      return std::tie(p.kind, p.y, p.x) < std::tie(q.kind, q.y, q.x);
    };
    std::sort(covered.begin(), covered.end(), by_place);
    EXPECT_EQ(covered, expected) << cell;
    bricks += expected.size();
  }
  EXPECT_GT(bricks, 1500u);
  EXPECT_LT(blocks * 6, bricks);
}

TEST(DrawBricks, FillsExactlyThePixelsOfBricks) {
  const FeatherStore store = SmallCity();
  DrawList list(TestFont());
  list.Begin(800, 600);
  Viewport viewport;
  viewport.panel = {0, 0, 800, 600};
  viewport.centre = Vec2(-8, 7);
  for (const float px_per_m : {20.0f, 60.0f}) {
    viewport.px_per_m = px_per_m;
    list.Begin(800, 600);
    DrawBricks(list, viewport, store);
    const Image image = Rendered(list);
    int filled = 0;
    for (int y = 1; y < 600; y += 3) {
      for (int x = 1; x < 800; x += 3) {
        // Three pixels from every outline and joint, or the pixel says nothing.
        const Vec2 at = viewport.ToWorld(Vec2(static_cast<float>(x), static_cast<float>(y)) +
                                         Vec2(0.5f, 0.5f)) /
                        kBrickUnit;
        const float clear = 3 / (px_per_m * kBrickUnit);
        const auto near = [&](float out) {
          return store.InBox(static_cast<int>(std::floor(at.x() - out)),
                             static_cast<int>(std::floor(at.y() - out)),
                             static_cast<int>(std::floor(at.x() + out)) + 1,
                             static_cast<int>(std::floor(at.y() + out)) + 1);
        };
        const Colour colour = PixelAt(image, Vec2(static_cast<float>(x), static_cast<float>(y)));
        if (near(clear).empty()) {
          ASSERT_EQ(colour, kPaper) << x << ", " << y;
        } else if (!near(0).empty() && colour == kGround) {
          ++filled;
        }
      }
    }
    EXPECT_GT(filled, 5000) << px_per_m;
  }
}

TEST(DrawBricks, AMillionBricksFromFarAreFewTriangles) {
  const Scene scene = LoadScene("scenes/skyline.toml");
  const FeatherStore store(scene.bricks);
  EXPECT_GT(store.size(), 1000000u);
  DrawList list(TestFont());
  for (const float px_per_m : {0.1f, 0.9f, 8.0f, 100.0f}) {
    list.Begin(800, 600);
    Viewport viewport;
    viewport.panel = {0, 0, 800, 600};
    viewport.centre = Vec2(3, 20);
    viewport.px_per_m = px_per_m;
    DrawBricks(list, viewport, store);
    EXPECT_GT(list.indices().size() / 3, 50u) << px_per_m;
    EXPECT_LT(list.indices().size() / 3, 60000u) << px_per_m;
  }
}

}  // namespace render_bricks_test
}  // namespace seam
