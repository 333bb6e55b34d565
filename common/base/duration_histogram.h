#pragma once
/// How long things took, in 16 classes for each doubling: percentiles that are at most 6 % too
/// high, in a fixed amount of memory. The layout is that of HdrHistogram.

#include <array>
#include <cstdint>

namespace seam {

class DurationHistogram {
 public:
  /// Less than 0 counts as 0.
  void Add(std::int64_t us);
  void Add(const DurationHistogram& other);
  std::int64_t count() const { return count_; }
  std::int64_t max_us() const { return max_us_; }
  /// The time that at least `share` (0..1) of all did not exceed, to the upper bound of its class,
  /// but never more than max_us(); 0 of nothing.
  std::int64_t PercentileUs(double share) const;

 private:
  static constexpr int kHalf = 16;       // classes of a doubling
  static constexpr int kDoublings = 40;  // 2^40 us: 12 days
  std::array<std::int64_t, (kDoublings + 2) * kHalf> classes_{};
  std::int64_t count_ = 0;
  std::int64_t max_us_ = 0;
};

}  // namespace seam
