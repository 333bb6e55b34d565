#pragma once
/// Tells damaged tick numbers in a stream of views from the stream's own.

#include <algorithm>
#include <cstdint>

namespace seam {

class StrayTicks {
 public:
  /// Returns true for a tick that is far from the newest; notes any other.
  bool IsStray(std::int64_t tick) {
    if (newest_ < 0 || (tick < newest_ + kAheadTicks && tick > newest_ - kAgoTicks)) {
      newest_ = std::max(newest_, tick);
      strays_ = 0;
      return false;
    }
    ++strays_;
    return true;
  }
  /// True after many strays in a row: the stream has begun anew.
  bool restarted() const { return strays_ >= kStraysMax; }
  /// Returns the greatest tick that was no stray; -1: none.
  std::int64_t newest() const { return newest_; }

 private:
  static constexpr std::int64_t kAheadTicks = 3600;  // further ahead is a stray
  static constexpr std::int64_t kAgoTicks = 600;     // so long ago, too
  static constexpr int kStraysMax = 30;

  std::int64_t newest_ = -1;
  int strays_ = 0;
};

}  // namespace seam
