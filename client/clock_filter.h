#pragma once
/// Estimates the server's clock from pings: trusts the least-delayed answers and, once settled,
/// slews only slowly, so that simulated time never jumps.

#include <array>
#include <cstdint>

namespace seam {

class ClockFilter {
 public:
  /// Adds a ping sent at `sent_us` (our clock), answered at `server_us` (the server's clock) and
  /// received at `received_us` (our clock). Ignores samples received before they were sent.
  void AddSample(std::int64_t sent_us, std::int64_t server_us, std::int64_t received_us);

  /// True if there are enough samples to start with.
  bool settled() const { return samples_ >= kSettleSamples; }

  /// Returns the server's clock at our `now_us`. Once settled it never runs backwards while now_us
  /// grows: it slews towards the best estimate by at most kSlewPpm (kSlewFarPpm when far off).
  std::int64_t ServerTime(std::int64_t now_us);

  /// Returns the least round trip in the window; -1 before the first sample.
  std::int64_t rtt_min_us() const;
  /// Returns the 90th percentile of round trips in the window; -1 before the first sample.
  std::int64_t rtt_p90_us() const;
  /// Returns the offset still to be slewed, us.
  std::int64_t pending_us() const { return static_cast<std::int64_t>(target_ - offset_); }

  static constexpr int kSettleSamples = 8;
  static constexpr double kSlewPpm = 2000;      ///< 2 ms a second: invisible
  static constexpr double kSlewFarPpm = 50000;  ///< more than 50 ms off: a stepped clock
 private:
  static constexpr int kWindow = 32;
  struct Sample {
    std::int64_t rtt_us = 0;
    std::int64_t offset_us = 0;
  };
  std::array<Sample, kWindow> window_{};
  std::int64_t samples_ = 0;
  double target_ = 0;  // best estimate of the server's clock minus ours, us
  double offset_ = 0;  // in use, us
  bool used_ = false;
  std::int64_t last_now_us_ = 0;
};

}  // namespace seam
