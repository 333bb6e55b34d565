#pragma once
/// The ages of what was received lately, and the age that most of it stays below.

#include <algorithm>
#include <cstdint>
#include <deque>
#include <vector>

namespace seam {

/// Keeps the last kAgesKept ages.
class RecentAges {
 public:
  static constexpr std::size_t kAgesKept = 90;
  /// Records an age, ticks. Ages below 0 count as 0.
  void Add(std::int64_t ticks) {
    ages_.push_back(std::max<std::int64_t>(0, ticks));
    if (ages_.size() > kAgesKept) ages_.pop_front();
  }
  /// Acts like kAgesKept ages of `ticks`.
  void Fill(std::int64_t ticks) { ages_.assign(kAgesKept, ticks); }
  bool empty() const { return ages_.empty(); }
  /// Returns the age that 19 of 20 do not exceed, ticks. Requires an age.
  std::int64_t Most() const {
    std::vector<std::int64_t> sorted(ages_.begin(), ages_.end());
    const auto rank = static_cast<std::ptrdiff_t>((sorted.size() - 1) * 19 / 20);
    std::nth_element(sorted.begin(), sorted.begin() + rank, sorted.end());
    return sorted[static_cast<std::size_t>(rank)];
  }

 private:
  std::deque<std::int64_t> ages_;
};

}  // namespace seam
