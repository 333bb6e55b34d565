#pragma once
/// Nearest-rank percentiles.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace seam {

/// Returns the least value that at least `share` of all values do not exceed; 0 without values.
/// Reorders `values`.
inline double Percentile(std::vector<double>& values, double share) {
  if (values.empty()) return 0;
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  const auto index = static_cast<std::size_t>(std::max(rank, 1.0)) - 1;
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(index);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

}  // namespace seam
