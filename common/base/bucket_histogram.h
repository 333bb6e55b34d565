#pragma once
/// How long things took since the beginning, in the few buckets of a Prometheus histogram: what is
/// counted between two looks is their difference.

#include <array>
#include <cstddef>
#include <cstdint>

namespace seam {

struct BucketHistogram {
  /// Upper bounds of the buckets, us: half as much again each. What takes longer is in count alone.
  static constexpr std::array<std::int64_t, 21> kBoundsUs = {
      100,  150,   220,   330,   470,   680,   1000,  1500,   2200,   3300,  4700,
      6800, 10000, 15000, 22000, 33000, 47000, 68000, 100000, 150000, 250000};

  std::array<std::int64_t, kBoundsUs.size()> at_most{};  ///< how many took at most kBoundsUs[i]
  std::int64_t count = 0;
  std::int64_t sum_us = 0;

  /// Less than 0 counts as 0.
  void Add(std::int64_t us);
  void Add(const BucketHistogram& other);
  /// What has come since it was `before`; all of it if that has more: it was begun anew meanwhile.
  BucketHistogram Since(const BucketHistogram& before) const;
  /// As Prometheus' histogram_quantile: the time, us, that `share` (0..1) of all did not exceed,
  /// on a line between the bounds of its bucket; beyond the last bound that bound; 0 of nothing.
  double QuantileUs(double share) const;
};

}  // namespace seam
