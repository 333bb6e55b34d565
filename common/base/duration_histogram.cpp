#include "common/base/duration_histogram.h"

#include <algorithm>
#include <cmath>

namespace seam {

void DurationHistogram::Add(std::int64_t us, std::int64_t times) {
  if (times <= 0) return;
  const std::int64_t most = (std::int64_t{1} << kDoublings) - 1;
  const std::int64_t value = std::clamp<std::int64_t>(us, 0, most);
  int shift = 0;  // so that value >> shift is below 2 * kHalf
  while (value >> shift >= 2 * kHalf) ++shift;
  // Below 2 * kHalf each value has a class of its own; then each doubling has kHalf of them.
  const auto index = static_cast<std::size_t>(shift * kHalf + (value >> shift));
  classes_[index] += times;
  count_ += times;
  max_us_ = std::max(max_us_, value);
}

void DurationHistogram::Add(const DurationHistogram& other) {
  for (std::size_t i = 0; i < classes_.size(); ++i) classes_[i] += other.classes_[i];
  count_ += other.count_;
  max_us_ = std::max(max_us_, other.max_us_);
}

std::int64_t DurationHistogram::PercentileUs(double share) const {
  if (count_ == 0) return 0;
  const auto wanted = static_cast<std::int64_t>(std::ceil(share * static_cast<double>(count_)));
  std::int64_t seen = 0;
  for (std::size_t i = 0; i < classes_.size(); ++i) {
    seen += classes_[i];
    if (seen < std::max<std::int64_t>(1, wanted)) continue;
    const auto index = static_cast<std::int64_t>(i);
    const std::int64_t shift = index < 2 * kHalf ? 0 : index / kHalf - 1;
    const std::int64_t upper = ((index - shift * kHalf + 1) << shift) - 1;
    return std::min(upper, max_us_);
  }
  return max_us_;
}

}  // namespace seam
