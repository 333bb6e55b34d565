#include "tests/lab/report/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace seam {

std::optional<Quartiles> FindQuartiles(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  for (double& value : values) {
    if (std::isnan(value)) value = std::numeric_limits<double>::infinity();
  }
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  const auto quarter = [&](std::size_t k) { return values[(k * n + 3) / 4 - 1]; };
  return Quartiles{quarter(1), quarter(2), quarter(3), n};
}

std::vector<std::size_t> ParetoFront(const std::vector<CostError>& trials) {
  std::vector<std::size_t> order(trials.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (trials[a].cost != trials[b].cost) return trials[a].cost < trials[b].cost;
    return trials[a].error < trials[b].error;
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    if (!std::isfinite(trials[i].cost) || !std::isfinite(trials[i].error)) continue;
    if (front.empty() || trials[i].error < trials[front.back()].error) front.push_back(i);
  }
  return front;
}

}  // namespace seam
