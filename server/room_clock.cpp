#include "server/room_clock.h"

#include <algorithm>
#include <utility>

namespace seam {
namespace {

/// Achieved speed, in percent of the clock's, from which on a late server counts as catching up.
constexpr std::int64_t kCatchesUpPercent = 105;
/// New speed after a slowdown, in percent of the achieved one: the rest is a margin for other work.
constexpr std::int64_t kKeepPercent = 95;
/// Least speed after a slowdown, in percent of the one before: a burst of work shorter than two
/// slowdowns does not stop the room.
constexpr std::int64_t kSlowerPercent = 50;
/// First gain of speed when the server is in time, percent. It doubles with each attempt that does
/// not fail: a room that was slowed by a burst is back in two seconds.
constexpr std::int64_t kGainPercent = 10;
/// Further loss of speed that is reported, ppm.
constexpr std::int32_t kSayPpm = 100000;

}  // namespace

void RoomClock::Start(std::int64_t tick0_us) {
  started_ = true;
  anchor_us_ = tick0_us;
  window_us_ = tick0_us;
  window_tick_ = 0;
}

void RoomClock::GoOn(std::int64_t now_us, std::int64_t tick) {
  Start(now_us);
  anchor_room_us_ = PeriodUs(tick);
  window_tick_ = tick;
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

/// Gives up the backlog: the next tick is due now.
void RoomClock::SlowDown(std::int64_t now_us, std::int64_t tick, std::int64_t achieved_ppm) {
  bad_windows_ = 0;
  const bool failed = std::exchange(gain_percent_, 0) > 0;
  if (failed) needs_good_ = std::min(2 * needs_good_, kGoodWindowsMax);
  const std::int64_t speed_ppm = speed_ppm_;
  SetSpeed(now_us, PeriodUs(tick + 1),
           std::max(std::min(achieved_ppm, speed_ppm) * kKeepPercent / 100,
                    speed_ppm * kSlowerPercent / 100));
}

void RoomClock::SpeedUp(std::int64_t now_us) {
  good_windows_ = 0;
  if (gain_percent_ > 0) needs_good_ = std::max(needs_good_ / 2, kGoodWindows);
  gain_percent_ = gain_percent_ > 0 ? 2 * gain_percent_ : kGainPercent;
  SetSpeed(now_us, RoomUs(now_us), speed_ppm_ * (100 + gain_percent_) / 100);
}

bool RoomClock::Note(std::int64_t now_us, std::int64_t tick) {
  if (!started_ || now_us - window_us_ < kWindowUs) return false;
  const std::int64_t late_us = now_us - DueUs(tick + 1);
  // Time of the ticks done since a moment, ppm of real time.
  const auto achieved_ppm = [&](std::int64_t since_us, std::int64_t since_tick) {
    return PeriodUs(tick - since_tick) * 1000000 / (now_us - since_us);
  };
  const bool catches_up =
      achieved_ppm(window_us_, window_tick_) * 100 >= kCatchesUpPercent * speed_ppm_;
  const bool bad = late_us > kLateUs && !catches_up;
  if (bad && bad_windows_ == 0) {
    bad_us_ = window_us_;
    bad_tick_ = window_tick_;
  }
  window_us_ = now_us;
  window_tick_ = tick;
  bad_windows_ = bad ? bad_windows_ + 1 : 0;
  good_windows_ = late_us < PeriodUs(1) ? good_windows_ + 1 : 0;
  if (bad_windows_ >= kBadWindows) {
    SlowDown(now_us, tick, achieved_ppm(bad_us_, bad_tick_));
  } else if (speed_ppm_ < kFullSpeedPpm && good_windows_ >= needs_good_) {
    SpeedUp(now_us);
  }
  if (speed_ppm_ == kFullSpeedPpm && good_windows_ >= kGoodWindowsMax) {
    gain_percent_ = 0;
    needs_good_ = kGoodWindows;
    return std::exchange(said_ppm_, kFullSpeedPpm) < kFullSpeedPpm;
  }
  const bool first = said_ppm_ == kFullSpeedPpm && speed_ppm_ < kFullSpeedPpm;
  if (!first && said_ppm_ - speed_ppm_ < kSayPpm) return false;
  said_ppm_ = speed_ppm_;
  return true;
}

}  // namespace seam
