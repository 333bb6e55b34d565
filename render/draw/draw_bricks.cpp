#include "render/draw/draw_bricks.h"

#include <algorithm>
#include <cmath>

#include "common/stages/bricks/feather_outline.h"
#include "render/canvas/palette.h"

namespace seam {
namespace {

/// Below these sizes on the page, px, a cell is drawn as a shade and a brick without joints.
constexpr float kCellMin = 10, kBrickMin = 4;

Vec2 Place(const Viewport& viewport, int x, int y) {
  return viewport.ToPx(Vec2(static_cast<float>(x), static_cast<float>(y)) * kBrickUnit);
}

std::vector<Vec2> Corners(const Viewport& viewport, int x0, int y0, int x1, int y1) {
  return {Place(viewport, x0, y0), Place(viewport, x1, y0), Place(viewport, x1, y1),
          Place(viewport, x0, y1)};
}

/// Draws one rectangle around the cell's bricks, paler with lower density.
void DrawShade(DrawList& list, const Viewport& viewport, const FeatherStore& store,
               const std::vector<BrickBlock>& blocks) {
  int x0 = blocks[0].x, y0 = blocks[0].y, x1 = x0, y1 = y0;
  double solid = 0;
  for (const BrickBlock& b : blocks) {
    const BrickKind& kind = store.kinds()[static_cast<std::size_t>(b.kind)];
    x0 = std::min(x0, b.x);
    y0 = std::min(y0, b.y);
    x1 = std::max(x1, b.x + b.columns * kind.width);
    y1 = std::max(y1, b.y + b.rows * kind.height);
    solid += static_cast<double>(b.columns * kind.width) * (b.rows * kind.height);
  }
  const double area = static_cast<double>(x1 - x0) * (y1 - y0);
  const auto share = static_cast<float>(std::min(1.0, solid / area));
  list.Fill(Corners(viewport, x0, y0, x1, y1), Faded(Mix(kGround, kGroundEdge, 0.3f), share));
}

/// Draws the joints within a block.
void DrawJoints(DrawList& list, const Viewport& viewport, const BrickBlock& b,
                const BrickKind& kind) {
  const Line line{1, Faded(kGroundEdge, 0.3f), 0};
  const int x1 = b.x + b.columns * kind.width, y1 = b.y + b.rows * kind.height;
  for (int row = 1; row < b.rows; ++row) {
    const int y = b.y + row * kind.height;
    list.Stroke({Place(viewport, b.x, y), Place(viewport, x1, y)}, false, line);
  }
  for (int column = 1; column < b.columns; ++column) {
    const int x = b.x + column * kind.width;
    list.Stroke({Place(viewport, x, b.y), Place(viewport, x, y1)}, false, line);
  }
}

void DrawCell(DrawList& list, const Viewport& viewport, const FeatherStore& store, int cell) {
  const std::vector<BrickBlock> blocks = BlocksOf(store, cell);
  if (blocks.empty()) return;
  const float unit_px = kBrickUnit * viewport.px_per_m;
  if (unit_px * FeatherStore::kCell < kCellMin) {
    DrawShade(list, viewport, store, blocks);
    return;
  }
  for (const BrickBlock& b : blocks) {
    const BrickKind& kind = store.kinds()[static_cast<std::size_t>(b.kind)];
    list.Fill(Corners(viewport, b.x, b.y, b.x + b.columns * kind.width, b.y + b.rows * kind.height),
              kGround);
    const auto least = static_cast<float>(std::min(kind.width, kind.height));
    if (least * unit_px >= kBrickMin) DrawJoints(list, viewport, b, kind);
  }
}

void DrawOutlines(DrawList& list, const Viewport& viewport, const FeatherStore& store, int cell) {
  const float unit_px = kBrickUnit * viewport.px_per_m;
  if (unit_px * FeatherStore::kCell < 3 * kCellMin) return;
  const float width = std::clamp(unit_px, 0.6f, 1.3f) * list.font().scale();
  std::vector<Vec2> px;
  for (const OutlinePath& path : OutlinesOf(store, store.cell_x(cell), store.cell_y(cell))) {
    px.clear();
    for (const auto& corner : path.corners) px.push_back(Place(viewport, corner.x, corner.y));
    list.Stroke(px, path.closed, {width, kGroundEdge, 0});
  }
}

}  // namespace

std::vector<BrickBlock> BlocksOf(const FeatherStore& store, int cell) {
  std::vector<Brick> bricks;
  store.Append(cell, &bricks);  // by kind, then y, then x
  std::vector<BrickBlock> blocks;
  std::size_t row_before = 0, row = 0;  // first block of the kind; first block of the current row
  const auto close_row = [&] {
    // A block on top of another with the same left and right edges is merged with it.
    std::size_t kept = row;
    for (std::size_t i = row; i < blocks.size(); ++i) {
      const BrickBlock b = blocks[i];
      bool merged = false;
      for (std::size_t j = row_before; j < row && !merged; ++j) {
        BrickBlock& below = blocks[j];
        const int height = store.kinds()[static_cast<std::size_t>(b.kind)].height;
        merged = below.kind == b.kind && below.x == b.x && below.columns == b.columns &&
                 below.y + below.rows * height == b.y;
        if (merged) ++below.rows;
      }
      if (!merged) blocks[kept++] = b;
    }
    blocks.resize(kept);
  };
  for (std::size_t i = 0; i < bricks.size(); ++i) {
    const Brick& b = bricks[i];
    const int width = store.kinds()[static_cast<std::size_t>(b.kind)].width;
    const bool new_row = i == 0 || bricks[i - 1].y != b.y || bricks[i - 1].kind != b.kind;
    if (new_row) {
      close_row();
      if (i > 0 && bricks[i - 1].kind != b.kind) row_before = blocks.size();
      row = blocks.size();
    }
    BrickBlock* last = new_row || blocks.empty() ? nullptr : &blocks.back();
    if (last != nullptr && last->x + last->columns * width == b.x) {
      ++last->columns;
    } else {
      blocks.push_back({b.x, b.y, 1, 1, b.kind});
    }
  }
  close_row();
  return blocks;
}

void DrawBricks(DrawList& list, const Viewport& viewport, const FeatherStore& store) {
  if (store.cell_count() == 0) return;
  const Rect& panel = viewport.panel;
  const Vec2 low = viewport.ToWorld({panel.x, panel.bottom()});
  const Vec2 high = viewport.ToWorld({panel.right(), panel.y});
  const auto cell_of = [](float metres) {
    const float cells = metres / (FeatherStore::kCell * kBrickUnit);
    return static_cast<int>(std::floor(std::clamp(cells, -1e6f, 1e6f)));
  };
  // A brick of the previous cell may reach in.
  const int x0 = std::max(cell_of(low.x()) - 1, store.cell_x_min());
  const int y0 = std::max(cell_of(low.y()) - 1, store.cell_y_min());
  const int x1 = std::min(cell_of(high.x()), store.cell_x_max());
  const int y1 = std::min(cell_of(high.y()), store.cell_y_max());
  for (const auto draw : {DrawCell, DrawOutlines}) {
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const int cell = store.CellAt(x, y);
        if (cell >= 0) draw(list, viewport, store, cell);
      }
    }
  }
}

}  // namespace seam
