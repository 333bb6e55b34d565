#include "common/codec/packed/range_coder.h"

#include <cmath>
#include <cstdlib>

namespace seam {

NumberModel::NumberModel(double zero, int width) : zero_(zero, 4) {
  // Widths are the rarer the further they are from the usual one: half for each two bits. Each node
  // of the tree expects the share of its right half; leaves come first.
  std::array<double, 2 * kWidths> mass{};
  for (std::size_t i = 0; i < kWidths; ++i) {
    mass[kWidths + i] = std::exp2(-0.7 * std::abs(static_cast<int>(i) + 1 - width));
  }
  for (std::size_t node = kWidths - 1; node > 0; --node) {
    mass[node] = mass[2 * node] + mass[2 * node + 1];
    widths_[node] = BitModel(mass[2 * node + 1] / mass[node], 3);
  }
}

}  // namespace seam
