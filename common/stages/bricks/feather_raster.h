#pragma once
/// Rasterises a cell's bricks and a rim of one unit around it, on a grid with lines at the bricks'
/// sides.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/topology/feather_store.h"

namespace seam {

/// Grid of squares, as wide and high as the bricks allow: few. The outermost squares are the rim.
class FeatherRaster {
 public:
  FeatherRaster(const FeatherStore& store, int cell_x, int cell_y);

  int columns() const { return static_cast<int>(xs_.size()) - 1; }
  int rows() const { return static_cast<int>(ys_.size()) - 1; }
  /// Grid lines, units: 0..columns(), 0..rows().
  int x(int line) const { return xs_[static_cast<std::size_t>(line)]; }
  int y(int line) const { return ys_[static_cast<std::size_t>(line)]; }
  bool Solid(int column, int row) const { return At(column, row) != kAir; }
  /// Returns -1 for air and for the rim.
  int Surface(int column, int row) const {
    const bool rim = column == 0 || row == 0 || column == columns() - 1 || row == rows() - 1;
    return rim || !Solid(column, row) ? -1 : At(column, row) - 1;
  }

 private:
  static constexpr std::uint8_t kAir = 0;  // otherwise 1 + surface
  std::uint8_t At(int column, int row) const {
    return squares_[static_cast<std::size_t>(row) * (xs_.size() - 1) +
                    static_cast<std::size_t>(column)];
  }

  std::vector<int> xs_, ys_;
  std::vector<std::uint8_t> squares_;
};

}  // namespace seam
