#pragma once
/// Root mean squares, summed value by value.

#include <cmath>
#include <cstdint>
#include <optional>

namespace seam {

/// A running sum of squares.
struct MeanSquare {
  double sum = 0;
  std::int64_t count = 0;

  void Add(double squared) {
    sum += squared;
    ++count;
  }
  /// Returns the root mean square; nullopt without values.
  std::optional<double> Root() const {
    if (count == 0) return std::nullopt;
    return std::sqrt(sum / static_cast<double>(count));
  }
  double RootOrZero() const { return Root().value_or(0); }
};

}  // namespace seam
