#pragma once
/// What the room's clock shows, as the server's pongs tell it. It follows a clock that is slowed
/// down without ever running backwards.

#include <cstdint>

#include "common/codec/messages.h"

namespace seam {

class RoomTimeline {
 public:
  /// Whether the room's clock is known.
  bool known() const { return tick0_us_ >= 0; }
  /// Takes a pong; one that is older than the newest is ignored.
  void Add(const Pong& pong);
  /// Room time, us, at `server_us` on the server's clock, which must not run backwards. Where the
  /// room's clock was slowed down before we heard of it, ours goes at half its speed until the two
  /// agree. Requires known().
  std::int64_t At(std::int64_t server_us);
  /// The real time that the room's clock takes for `room_us`, us.
  std::int64_t RealUs(std::int64_t room_us) const { return room_us * kFullSpeedPpm / speed_ppm_; }
  /// Of real time, per million.
  std::int32_t speed_ppm() const { return speed_ppm_; }

 private:
  std::int64_t tick0_us_ = -1;  // of the newest pong
  std::int64_t told_us_ = -1;   // the server's clock when it said so
  std::int32_t speed_ppm_ = kFullSpeedPpm;
  bool used_ = false;
  std::int64_t last_us_ = 0, last_server_us_ = 0;  // what At returned, and for when
};

}  // namespace seam
