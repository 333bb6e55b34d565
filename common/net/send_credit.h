#pragma once
/// Bytes that may be sent now at a rate: a token bucket.

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace seam {

class SendCredit {
 public:
  /// Fills up to now, at `bytes_per_s`.
  void Fill(std::int64_t now_us, double bytes_per_s) {
    most_ = std::max(kBurst * bytes_per_s, kBurstLeast);
    const double passed_s =
        filled_us_ < 0 ? kBurst : 1e-6 * static_cast<double>(now_us - filled_us_);
    filled_us_ = now_us;
    // A large message delays those after it by no more than a burst.
    bytes_ = std::min(std::max(bytes_, -most_) + passed_s * bytes_per_s, most_);
  }
  void Spend(std::size_t bytes) { bytes_ -= static_cast<double>(bytes); }
  /// Returns the bytes as of the last Fill; negative: more was sent.
  double bytes() const { return bytes_; }
  /// True if a datagram is worth its header.
  bool Ready() const { return bytes_ >= std::min(most_ / 2, kWorth); }

  /// s of the rate that may be sent at once.
  static constexpr double kBurst = 0.1;
  /// Burst of the thinnest lines, and the least part of it that is sent, bytes.
  static constexpr double kBurstLeast = 180, kWorth = 130;

 private:
  double bytes_ = 0, most_ = kBurstLeast;
  std::int64_t filled_us_ = -1;
};

}  // namespace seam
