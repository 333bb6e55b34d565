#include "common/stages/bricks/feather_raster.h"

#include <algorithm>

namespace seam {
namespace {

/// Grid lines of one axis, from one outer side of the rim to the other, and the line at each unit.
class Axis {
 public:
  explicit Axis(int cell) : from_(cell * FeatherStore::kCell - 1), marked_(kUnits + 1, false) {
    for (const int unit : {0, 1, kUnits - 1, kUnits}) Mark(from_ + unit);
  }
  int Clamped(int units) const { return std::clamp(units - from_, 0, kUnits); }
  void Mark(int units) { marked_[static_cast<std::size_t>(Clamped(units))] = true; }
  /// Requires that all lines are marked.
  std::vector<int> Lines() {
    std::vector<int> lines;
    rank_.resize(marked_.size());
    for (int unit = 0; unit <= kUnits; ++unit) {
      const auto u = static_cast<std::size_t>(unit);
      rank_[u] = static_cast<int>(lines.size());
      if (marked_[u]) lines.push_back(from_ + unit);
    }
    return lines;
  }
  std::size_t LineAt(int units) const {
    return static_cast<std::size_t>(rank_[static_cast<std::size_t>(Clamped(units))]);
  }

 private:
  static constexpr int kUnits = FeatherStore::kCell + 2;
  int from_;
  std::vector<bool> marked_;
  std::vector<int> rank_;
};

}  // namespace

FeatherRaster::FeatherRaster(const FeatherStore& store, int cell_x, int cell_y) {
  const int x0 = cell_x * FeatherStore::kCell - 1, y0 = cell_y * FeatherStore::kCell - 1;
  const int side = FeatherStore::kCell + 2;
  const std::vector<Brick> bricks = store.InBox(x0, y0, x0 + side, y0 + side);
  Axis across(cell_x), up(cell_y);
  for (const Brick& b : bricks) {
    const BrickKind& kind = store.kinds()[static_cast<std::size_t>(b.kind)];
    across.Mark(b.x);
    across.Mark(b.x + kind.width);
    up.Mark(b.y);
    up.Mark(b.y + kind.height);
  }
  xs_ = across.Lines();
  ys_ = up.Lines();
  const std::size_t columns = xs_.size() - 1;
  squares_.assign(columns * (ys_.size() - 1), kAir);
  for (const Brick& b : bricks) {
    const BrickKind& kind = store.kinds()[static_cast<std::size_t>(b.kind)];
    for (std::size_t row = up.LineAt(b.y); row < up.LineAt(b.y + kind.height); ++row) {
      for (std::size_t c = across.LineAt(b.x); c < across.LineAt(b.x + kind.width); ++c) {
        std::uint8_t& square = squares_[row * columns + c];
        if (square == kAir) square = static_cast<std::uint8_t>(1 + kind.surface);
      }
    }
  }
}

}  // namespace seam
