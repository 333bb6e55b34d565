#pragma once
/// Histogram of tick durations: percentiles over a session of any length.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace seam {

class TickTimes {
 public:
  /// Width of a bin, and so the resolution, us.
  static constexpr std::int64_t kBinUs = 20;

  /// Adds `ticks` ticks that took `us` together. Does nothing if `ticks` is 0.
  void Note(std::int64_t us, std::int64_t ticks) {
    if (ticks <= 0) return;
    const std::int64_t bin = std::max<std::int64_t>(0, us) / ticks / kBinUs;
    bins_[std::min(static_cast<std::size_t>(bin), kBins - 1)] += ticks;
    count_ += ticks;
  }
  /// Returns the time that `percent` of the ticks did not exceed, us, rounded up to a bin; 0
  /// without ticks. Ticks above 100 ms count as 100 ms.
  std::int64_t Percentile(int percent) const {
    std::int64_t rest = (count_ * percent + 99) / 100;
    for (std::size_t bin = 0; bin < kBins && count_ > 0; ++bin) {
      rest -= bins_[bin];
      if (rest <= 0) return (static_cast<std::int64_t>(bin) + 1) * kBinUs;
    }
    return 0;
  }

 private:
  static constexpr std::size_t kBins = 5000;
  std::array<std::int64_t, kBins> bins_{};
  std::int64_t count_ = 0;
};

}  // namespace seam
