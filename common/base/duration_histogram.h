#pragma once
/// A histogram of durations with 16 classes per doubling, laid out like HdrHistogram. Percentiles
/// are at most 6 % too high; memory is fixed.

#include <array>
#include <cstdint>

namespace seam {

class DurationHistogram {
 public:
  /// Counts a duration `times` times; a negative one counts as 0.
  void Add(std::int64_t us, std::int64_t times = 1);
  void Add(const DurationHistogram& other);
  std::int64_t count() const { return count_; }
  std::int64_t max_us() const { return max_us_; }
  /// Returns the percentile `share` (0..1): the upper bound of its class, at most max_us(). 0 for
  /// an empty histogram.
  std::int64_t PercentileUs(double share) const;

 private:
  static constexpr int kHalf = 16;       // classes per doubling
  static constexpr int kDoublings = 40;  // 2^40 us: 12 days
  std::array<std::int64_t, (kDoublings + 2) * kHalf> classes_{};
  std::int64_t count_ = 0;
  std::int64_t max_us_ = 0;
};

}  // namespace seam
