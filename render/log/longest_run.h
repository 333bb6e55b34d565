#pragma once
/// The run of numbers of a stream that has most of them: a damaged number is far from all others.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace seam {

class LongestRun {
 public:
  /// `pause_max`: numbers farther apart are of different runs.
  explicit LongestRun(std::int64_t pause_max) : pause_max_(pause_max) {}

  void Add(std::int64_t number) {
    for (Run& run : runs_) {
      if (number < run.first && Far(number, run.first)) continue;
      if (number > run.last && Far(number, run.last)) continue;
      run.first = std::min(run.first, number);
      run.last = std::max(run.last, number);
      ++run.count;
      return;
    }
    if (runs_.size() < kRunsMax) runs_.push_back({number, number, 1});
  }
  bool empty() const { return runs_.empty(); }
  /// Require at least one number.
  std::int64_t first() const { return Most().first; }
  std::int64_t last() const { return Most().last; }
  /// Returns the last minus the first; 0 without a number.
  std::int64_t length() const { return empty() ? 0 : last() - first(); }

 private:
  struct Run {
    std::int64_t first = 0, last = 0, count = 0;
  };
  static constexpr std::size_t kRunsMax = 64;

  bool Far(std::int64_t a, std::int64_t b) const {
    const auto low = static_cast<std::uint64_t>(std::min(a, b));
    return static_cast<std::uint64_t>(std::max(a, b)) - low >
           static_cast<std::uint64_t>(pause_max_);
  }
  const Run& Most() const {
    return *std::max_element(runs_.begin(), runs_.end(),
                             [](const Run& a, const Run& b) { return a.count < b.count; });
  }

  std::int64_t pause_max_;
  std::vector<Run> runs_;
};

}  // namespace seam
