#pragma once
/// What stands for many runs in a plot: median and quartiles, and which points nothing else beats.

#include <cstddef>
#include <optional>
#include <vector>

namespace seam {

/// Nearest rank, as the percentile of docs/metrics.md: of n values ascending, numbers ceil(n/4),
/// ceil(n/2) and ceil(3n/4). Each is a value that was measured.
struct Quartiles {
  double low = 0;
  double median = 0;
  double high = 0;
  std::size_t count = 0;  ///< of values
};

/// Nothing of nothing. Infinities are values, larger than all others; NaN counts as one of them.
std::optional<Quartiles> FindQuartiles(std::vector<double> values);

/// Something that was tried: what it costs, and how wrong it is.
struct CostError {
  double cost = 0;
  double error = 0;
};

/// The numbers of those trials than which no other is cheaper and no worse, or better and no
/// dearer; of equal ones the first. By rising cost, so by falling error. Trials that are not
/// finite are on no front.
std::vector<std::size_t> ParetoFront(const std::vector<CostError>& trials);

}  // namespace seam
