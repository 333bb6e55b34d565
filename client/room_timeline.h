#pragma once
/// The room's clock, as reported by the server's pongs. Follows a clock that is slowed down without
/// ever running backwards.

#include <cstdint>

#include "common/codec/messages.h"

namespace seam {

class RoomTimeline {
 public:
  /// True if the room's clock is known.
  bool known() const { return tick0_us_ >= 0; }
  /// Adds a pong; ignores one that is older than the newest.
  void Add(const Pong& pong);
  /// Returns room time, us, at `server_us` on the server's clock, which must not run backwards. If
  /// the room's clock was slowed down before we were told, ours runs at half its speed until the
  /// two agree. Requires known().
  std::int64_t At(std::int64_t server_us);
  /// Returns the real time in which the room's clock advances by `room_us`, us.
  std::int64_t RealUs(std::int64_t room_us) const { return room_us * kFullSpeedPpm / speed_ppm_; }
  /// Speed of the room's clock, per million of real time.
  std::int32_t speed_ppm() const { return speed_ppm_; }

 private:
  std::int64_t tick0_us_ = -1;  // from the newest pong
  std::int64_t told_us_ = -1;   // the server's clock in that pong
  std::int32_t speed_ppm_ = kFullSpeedPpm;
  bool used_ = false;
  std::int64_t last_us_ = 0, last_server_us_ = 0;  // last result of At, and its argument
};

}  // namespace seam
