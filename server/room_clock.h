#pragma once
/// When each tick of a room is due. It runs with real time while the server keeps up; when it does
/// not, the clock slows down for everyone alike, so that no peer falls behind the others.

#include <cstdint>

#include "common/codec/messages.h"

namespace seam {

class RoomClock {
 public:
  /// Stands still until Start.
  explicit RoomClock(int tick_hz) : tick_hz_(tick_hz) {}

  bool started() const { return started_; }
  /// Tick 0 is due at `tick0_us`.
  void Start(std::int64_t tick0_us);
  /// When the tick is due on the server's clock, us, if the speed stays as it is. Requires
  /// started().
  std::int64_t DueUs(std::int64_t tick) const;
  /// The room's clock shows, at the server's `now_us`, now_us - Tick0Us(now_us); -1: not started.
  std::int64_t Tick0Us(std::int64_t now_us) const;
  /// Of real time, per million: kLeastSpeedPpm .. kFullSpeedPpm.
  std::int32_t speed_ppm() const { return speed_ppm_; }

  /// To be called after the ticks that were due; `tick`: the last one. Measures, window by window,
  /// whether the server keeps up, and slows the clock down or speeds it up again. True when
  /// people should be told of the speed: it is much lower than the last time, or full again.
  bool Note(std::int64_t now_us, std::int64_t tick);

  /// A server is judged at the end of each window, us.
  static constexpr std::int64_t kWindowUs = 125000;
  /// Behind by less than this is nothing unusual, us: three ticks at 60 Hz.
  static constexpr std::int64_t kLateUs = 50000;
  /// So many windows in a row it must fail to catch up: one long stall is made up for instead.
  static constexpr int kBadWindows = 2;
  /// So many windows in a row it must be in time before it is given more to do.
  static constexpr int kGoodWindows = 8;

 private:
  std::int64_t RoomUs(std::int64_t now_us) const;
  std::int64_t PeriodUs(std::int64_t ticks) const { return ticks * 1000000 / tick_hz_; }
  void SetSpeed(std::int64_t now_us, std::int64_t room_us, std::int64_t speed_ppm);
  bool WorthSaying();

  int tick_hz_;
  bool started_ = false;
  std::int32_t speed_ppm_ = kFullSpeedPpm;
  std::int64_t anchor_us_ = 0;       // on the server's clock ...
  std::int64_t anchor_room_us_ = 0;  // ... and what the room's clock showed then
  std::int64_t window_us_ = 0;       // when the window began
  std::int64_t window_tick_ = 0;     // and the last tick then
  int bad_windows_ = 0, good_windows_ = 0;
  std::int32_t said_ppm_ = kFullSpeedPpm;
};

}  // namespace seam
