#pragma once
/// Makes this process as slow as a slower machine would be.

#include <time.h>

#include "common/base/process.h"

namespace seam {

class CpuThrottle {
 public:
  /// `factor`: how many times slower, at least 1.
  explicit CpuThrottle(double factor) : factor_(factor), until_now_us_(CpuUs()) {}

  /// Sleeps for as long as a slower machine would still compute what was done since the last call.
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
