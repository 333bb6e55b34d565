#include "client/clock_filter.h"

#include <algorithm>
#include <cmath>

namespace seam {

void ClockFilter::AddSample(std::int64_t sent_us, std::int64_t server_us,
                            std::int64_t received_us) {
  if (received_us < sent_us) return;
  Sample s;
  s.rtt_us = received_us - sent_us;
  s.offset_us = server_us - (sent_us + s.rtt_us / 2);
  window_[static_cast<std::size_t>(samples_ % kWindow)] = s;
  ++samples_;
  const auto count = static_cast<std::size_t>(std::min<std::int64_t>(samples_, kWindow));
  // The least-delayed samples are the most accurate (NTP's clock filter, RFC 5905 section 10). This
  // takes the mean of the best quarter, because with symmetric jitter the single best is noisy.
  std::array<Sample, kWindow> sorted = window_;
  std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count),
            [](const Sample& a, const Sample& b) {
              return a.rtt_us != b.rtt_us ? a.rtt_us < b.rtt_us : a.offset_us < b.offset_us;
            });
  const std::size_t best = std::max<std::size_t>(1, count / 4);
  double sum = 0;
  for (std::size_t i = 0; i < best; ++i) sum += static_cast<double>(sorted[i].offset_us);
  target_ = sum / static_cast<double>(best);
  if (!settled() || !used_) offset_ = target_;
}

std::int64_t ClockFilter::ServerTime(std::int64_t now_us) {
  if (settled()) {
    if (used_ && now_us > last_now_us_) {
      const double gap = target_ - offset_;
      const double ppm = std::fabs(gap) > 50000 ? kSlewFarPpm : kSlewPpm;
      const double most = static_cast<double>(now_us - last_now_us_) * ppm * 1e-6;
      offset_ += std::clamp(gap, -most, most);
    }
    used_ = true;
    last_now_us_ = std::max(last_now_us_, now_us);
  }
  return now_us + static_cast<std::int64_t>(std::llround(offset_));
}

std::int64_t ClockFilter::rtt_min_us() const {
  if (samples_ == 0) return -1;
  std::int64_t least = window_[0].rtt_us;
  for (std::int64_t i = 1; i < std::min<std::int64_t>(samples_, kWindow); ++i) {
    least = std::min(least, window_[static_cast<std::size_t>(i)].rtt_us);
  }
  return least;
}

std::int64_t ClockFilter::rtt_p90_us() const {
  if (samples_ == 0) return -1;
  const auto count = static_cast<std::size_t>(std::min<std::int64_t>(samples_, kWindow));
  std::array<std::int64_t, kWindow> rtts{};
  for (std::size_t i = 0; i < count; ++i) rtts[i] = window_[i].rtt_us;
  std::sort(rtts.begin(), rtts.begin() + static_cast<std::ptrdiff_t>(count));
  return rtts[(count * 9) / 10];
}

}  // namespace seam
