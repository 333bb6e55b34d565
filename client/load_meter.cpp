#include "client/load_meter.h"

#include <algorithm>

namespace seam {

void LoadMeter::Note(std::int64_t now_us, std::int64_t cpu_us, int ticks, std::int64_t late_us,
                     std::int64_t tick_us) {
  if (cpu_us <= 0) {
    began_us_ = -1;
    permille_ = -1;
    return;
  }
  if (ticks > 0) {
    ++calls_;
    late_ += late_us > tick_us ? 1 : 0;
    due_us_ += ticks * tick_us;
    Half& half = now_us - began_us_ < kMeterUs / 2 ? first_ : second_;
    ++half.calls;
    half.late_us += late_us;
  }
  if (began_us_ >= 0 && (now_us - began_us_ < kMeterUs || due_us_ == 0)) return;
  if (began_us_ >= 0) {
    std::int64_t load = (cpu_us - began_cpu_us_) * 1000 / due_us_;
    if (TooLate(static_cast<double>(tick_us))) load = std::max<std::int64_t>(load, kLateLoad);
    permille_ = static_cast<std::int16_t>(std::clamp<std::int64_t>(load, 0, 30000));
  }
  began_us_ = now_us;
  began_cpu_us_ = cpu_us;
  due_us_ = 0;
  calls_ = late_ = 0;
  first_ = second_ = {};
}

bool LoadMeter::TooLate(double tick_us) const {
  if (2 * late_ <= calls_) return false;
  const double much = kLateTicks * tick_us, trend = kTrend * tick_us;
  if (first_.calls == 0 || second_.calls == 0) {  // too few calls for a trend
    return static_cast<double>(first_.late_us + second_.late_us) > much * calls_;
  }
  const double later = second_.mean() - first_.mean();
  return later > trend || (later > -trend && second_.mean() > much);
}

}  // namespace seam
