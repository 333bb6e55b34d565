#pragma once
/// Grid of 8 m cells in flat arrays; finds the boxes that may be near a rectangle without checking
/// all of them.

#include <algorithm>
#include <vector>

#include "common/sync/reach/zones.h"

namespace seam {

class BoxGrid {
 public:
  /// Indexes all boxes, or only those with a nonzero entry in `use` (by box).
  explicit BoxGrid(const std::vector<MovingBox>& boxes, const std::vector<char>* use = nullptr);

  /// Calls `visit` (a box index) once for each box that overlaps the rectangle, and for some that
  /// lie a few cells beside it.
  template <class Visit>
  void Near(const Vec2& min, const Vec2& max, const Visit& visit) const {
    for (const int i : large_) visit(i);
    if (items_.empty()) return;
    const int from = Column(min.x() - widest_), to = Column(max.x() + widest_);
    const int top = Row(max.y() + widest_);
    for (int row = Row(min.y() - widest_); row <= top; ++row) {
      const int begin = start_[Cell(from, row)], end = start_[Cell(to, row) + 1];
      for (int k = begin; k < end; ++k) visit(items_[static_cast<std::size_t>(k)]);
    }
  }

  /// Cell size, m; normal 8. Larger only if the boxes are spread over very many cells.
  static constexpr float kCellSide = 8;

 private:
  // Boxes beyond the border are kept in the border's cells, and queries there look in these cells.
  static int Index(float at, int count) {
    return static_cast<int>(std::clamp(at, 0.0f, static_cast<float>(count - 1)));
  }
  int Column(float x) const { return Index((x - low_.x()) / cell_, columns_); }
  int Row(float y) const { return Index((y - low_.y()) / cell_, rows_); }
  std::size_t Cell(int column, int row) const {
    return static_cast<std::size_t>(row * columns_ + column);
  }
  void ChooseCells(const std::vector<Vec2>& centres);

  Vec2 low_{0, 0};
  float cell_ = kCellSide;
  int columns_ = 1, rows_ = 1;
  float widest_ = 0;        // half of the longest side among the boxes in cells, m
  std::vector<int> start_;  // by cell: index of its first box in items_; one more at the end
  std::vector<int> items_;  // box indices by cell, row by row
  std::vector<int> large_;  // boxes too large for cells
};

}  // namespace seam
