#pragma once
/// The room's clock: decides when each tick is due. It runs with real time while the server keeps
/// up. Otherwise it slows down for everyone alike, so that no peer falls behind the rest.

#include <cstdint>

#include "common/codec/messages.h"

namespace seam {

class RoomClock {
 public:
  /// Stands still until Start.
  explicit RoomClock(int tick_hz) : tick_hz_(tick_hz) {}

  bool started() const { return started_; }
  /// Starts the clock: tick 0 is due at `tick0_us`.
  void Start(std::int64_t tick0_us);
  /// Continues a room that has done `tick`: the next one is due a period after `now_us`.
  void GoOn(std::int64_t now_us, std::int64_t tick);
  /// Returns the time at which the tick is due on the server's clock, us, if the speed stays as it
  /// is. Requires started().
  std::int64_t DueUs(std::int64_t tick) const;
  /// Returns the server's time of tick 0, us, as if the clock had always run at full speed: the
  /// room's clock now shows now_us - Tick0Us(now_us). -1: not started.
  std::int64_t Tick0Us(std::int64_t now_us) const;
  /// Speed relative to real time, ppm: kLeastSpeedPpm .. kFullSpeedPpm.
  std::int32_t speed_ppm() const { return speed_ppm_; }

  /// To be called after the ticks that were due; `tick`: the last one. Measures in each window
  /// whether the server keeps up, and slows the clock down or speeds it up again. Returns true if
  /// the speed should be reported: much lower than in the last report, or full again for 2 s.
  bool Note(std::int64_t now_us, std::int64_t tick);

  /// Length of a measuring window, us.
  static constexpr std::int64_t kWindowUs = 125000;
  /// Largest usual lateness, us: three ticks at 60 Hz.
  static constexpr std::int64_t kLateUs = 50000;
  /// The clock slows down after this many windows in a row without catching up. After a single long
  /// stall the server catches up instead.
  static constexpr int kBadWindows = 2;
  /// The clock speeds up after this many windows in a row in time. Each attempt that fails doubles
  /// the number, up to the second one, and each that holds halves it: under a lasting load attempts
  /// are rare.
  static constexpr int kGoodWindows = 2, kGoodWindowsMax = 16;

 private:
  std::int64_t RoomUs(std::int64_t now_us) const;
  std::int64_t PeriodUs(std::int64_t ticks) const { return ticks * 1000000 / tick_hz_; }
  void SetSpeed(std::int64_t now_us, std::int64_t room_us, std::int64_t speed_ppm);
  void SlowDown(std::int64_t now_us, std::int64_t tick, std::int64_t achieved_ppm);
  void SpeedUp(std::int64_t now_us);

  int tick_hz_;
  bool started_ = false;
  std::int32_t speed_ppm_ = kFullSpeedPpm;
  std::int64_t anchor_us_ = 0;       // last change of speed, on the server's clock ...
  std::int64_t anchor_room_us_ = 0;  // ... and on the room's clock
  std::int64_t window_us_ = 0;       // begin of the window
  std::int64_t window_tick_ = 0;     // last tick before it
  int bad_windows_ = 0, good_windows_ = 0;
  std::int64_t bad_us_ = 0;        // begin of the first bad window in a row
  std::int64_t bad_tick_ = 0;      // last tick before it
  int needs_good_ = kGoodWindows;  // windows in time before the next attempt
  std::int64_t gain_percent_ = 0;  // of the last attempt; 0: it has failed, or held for long
  std::int32_t said_ppm_ = kFullSpeedPpm;
};

}  // namespace seam
