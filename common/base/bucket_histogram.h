#pragma once
/// A cumulative histogram of durations with the few buckets of a Prometheus histogram. Subtract two
/// readings to get the counts of the time between.

#include <array>
#include <cstddef>
#include <cstdint>

namespace seam {

struct BucketHistogram {
  /// Upper bounds of the buckets, us, each about 1.5 times the one before. Longer durations are
  /// in `count` only.
  static constexpr std::array<std::int64_t, 25> kBoundsUs = {
      100,    150,    220,    330,    470,    680,    1000,   1500,  2200,
      3300,   4700,   6800,   10000,  15000,  22000,  33000,  47000, 68000,
      100000, 150000, 250000, 330000, 470000, 680000, 1000000};

  std::array<std::int64_t, kBoundsUs.size()> at_most{};  ///< durations of at most kBoundsUs[i]
  std::int64_t count = 0;
  std::int64_t sum_us = 0;

  /// Counts a duration; a negative one counts as 0.
  void Add(std::int64_t us);
  void Add(const BucketHistogram& other);
  /// Returns the durations counted since the reading `before`. Returns everything if `before` has
  /// more: the histogram was restarted in between.
  BucketHistogram Since(const BucketHistogram& before) const;
  /// Returns the quantile `share` (0..1) in us like Prometheus' histogram_quantile: interpolated
  /// linearly within its bucket, at most the last bound. 0 for an empty histogram.
  double QuantileUs(double share) const;
};

}  // namespace seam
