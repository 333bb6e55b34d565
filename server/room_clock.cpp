#include "server/room_clock.h"

#include <algorithm>

namespace seam {
namespace {

/// Achieved speed, in percent of the clock's, from which on a late server counts as catching up.
constexpr std::int64_t kCatchesUpPercent = 105;
/// New speed after a slowdown, in percent of the achieved one: the rest is a margin for other work.
constexpr std::int64_t kKeepPercent = 95;
/// Next speed to try when the server is in time, in percent of the current one.
constexpr std::int64_t kFasterPercent = 110;
/// Further loss of speed that is reported, ppm.
constexpr std::int32_t kSayPpm = 100000;

}  // namespace

void RoomClock::Start(std::int64_t tick0_us) {
  started_ = true;
  anchor_us_ = tick0_us;
  window_us_ = tick0_us;
  window_tick_ = 0;
}

std::int64_t RoomClock::RoomUs(std::int64_t now_us) const {
  const std::int64_t real_us = now_us - anchor_us_;
  if (speed_ppm_ == kFullSpeedPpm) return anchor_room_us_ + real_us;
  return anchor_room_us_ + real_us * speed_ppm_ / 1000000;
}

std::int64_t RoomClock::DueUs(std::int64_t tick) const {
  const std::int64_t room_us = PeriodUs(tick) - anchor_room_us_;
  if (speed_ppm_ == kFullSpeedPpm) return anchor_us_ + room_us;
  return anchor_us_ + room_us * 1000000 / speed_ppm_;
}

std::int64_t RoomClock::Tick0Us(std::int64_t now_us) const {
  return started_ ? now_us - RoomUs(now_us) : -1;
}

void RoomClock::SetSpeed(std::int64_t now_us, std::int64_t room_us, std::int64_t speed_ppm) {
  anchor_us_ = now_us;
  anchor_room_us_ = room_us;
  speed_ppm_ =
      static_cast<std::int32_t>(std::clamp<std::int64_t>(speed_ppm, kLeastSpeedPpm, kFullSpeedPpm));
}

bool RoomClock::Note(std::int64_t now_us, std::int64_t tick) {
  if (!started_ || now_us - window_us_ < kWindowUs) return false;
  const std::int64_t late_us = now_us - DueUs(tick + 1);
  // Time of the ticks done in this window, ppm of real time.
  const std::int64_t achieved_ppm = PeriodUs(tick - window_tick_) * 1000000 / (now_us - window_us_);
  window_us_ = now_us;
  window_tick_ = tick;
  const bool catches_up = achieved_ppm * 100 >= kCatchesUpPercent * speed_ppm_;
  bad_windows_ = late_us > kLateUs && !catches_up ? bad_windows_ + 1 : 0;
  good_windows_ = late_us < PeriodUs(1) ? good_windows_ + 1 : 0;
  if (bad_windows_ >= kBadWindows) {
    // Gives up the backlog: the next tick is due now.
    bad_windows_ = 0;
    SetSpeed(now_us, PeriodUs(tick + 1),
             std::min<std::int64_t>(achieved_ppm, speed_ppm_) * kKeepPercent / 100);
  } else if (speed_ppm_ < kFullSpeedPpm && good_windows_ >= kGoodWindows) {
    good_windows_ = 0;
    SetSpeed(now_us, RoomUs(now_us), speed_ppm_ * kFasterPercent / 100);
  }
  return ShouldReport();
}

bool RoomClock::ShouldReport() {
  if (speed_ppm_ > said_ppm_) {  // speeding up: only full speed is reported
    said_ppm_ = speed_ppm_;
    return speed_ppm_ == kFullSpeedPpm;
  }
  const bool first = said_ppm_ == kFullSpeedPpm && speed_ppm_ < kFullSpeedPpm;
  if (!first && said_ppm_ - speed_ppm_ < kSayPpm) return false;
  said_ppm_ = speed_ppm_;
  return true;
}

}  // namespace seam
