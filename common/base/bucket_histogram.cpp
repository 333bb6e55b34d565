#include "common/base/bucket_histogram.h"

#include <algorithm>

namespace seam {

void BucketHistogram::Add(std::int64_t us) {
  const std::int64_t value = std::max<std::int64_t>(0, us);
  for (std::size_t i = 0; i < at_most.size(); ++i) at_most[i] += value <= kBoundsUs[i] ? 1 : 0;
  ++count;
  sum_us += value;
}

void BucketHistogram::Add(const BucketHistogram& other) {
  for (std::size_t i = 0; i < at_most.size(); ++i) at_most[i] += other.at_most[i];
  count += other.count;
  sum_us += other.sum_us;
}

BucketHistogram BucketHistogram::Since(const BucketHistogram& before) const {
  BucketHistogram since = *this;
  if (before.count > count) return since;
  for (std::size_t i = 0; i < at_most.size(); ++i) since.at_most[i] -= before.at_most[i];
  since.count -= before.count;
  since.sum_us -= before.sum_us;
  return since;
}

double BucketHistogram::QuantileUs(double share) const {
  if (count <= 0) return 0;
  const double rank = share * static_cast<double>(count);
  double lower_us = 0, below = 0;
  for (std::size_t i = 0; i < at_most.size(); ++i) {
    const auto upper_us = static_cast<double>(kBoundsUs[i]);
    const auto until = static_cast<double>(at_most[i]);
    if (until >= rank && until > below) {
      return lower_us + (upper_us - lower_us) * std::max(0.0, rank - below) / (until - below);
    }
    lower_us = upper_us;
    below = until;
  }
  return lower_us;
}

}  // namespace seam
