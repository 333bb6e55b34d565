#pragma once
/// Slows this process down to the speed of a slower machine.

#include <time.h>

#include "common/base/process.h"

namespace seam {

class CpuThrottle {
 public:
  /// `factor`: slowdown, at least 1.
  explicit CpuThrottle(double factor) : factor_(factor), until_now_us_(CpuUs()) {}

  /// Sleeps for the extra time that a slower machine would need for the work since the last call.
  void Slow() {
    const auto more = static_cast<double>(CpuUs() - until_now_us_) * (factor_ - 1);
    if (more >= 1) {
      timespec rest{};
      rest.tv_sec = static_cast<time_t>(more * 1e-6);
      rest.tv_nsec = static_cast<long>((more - static_cast<double>(rest.tv_sec) * 1e6) * 1e3);
      nanosleep(&rest, nullptr);
    }
    until_now_us_ = CpuUs();
  }

 private:
  const double factor_;
  std::int64_t until_now_us_;
};

}  // namespace seam
