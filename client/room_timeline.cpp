#include "client/room_timeline.h"

namespace seam {

void RoomTimeline::Add(const Pong& pong) {
  if (pong.tick0_us < 0 || pong.utime < told_us_) return;
  tick0_us_ = pong.tick0_us;
  told_us_ = pong.utime;
  speed_ppm_ = pong.speed_ppm;
}

std::int64_t RoomTimeline::At(std::int64_t server_us) {
  std::int64_t room_us = server_us - tick0_us_;
  if (speed_ppm_ != kFullSpeedPpm) {
    // In thousandths: the product of two long times would overflow.
    const std::int64_t since_us = server_us - told_us_;
    room_us = told_us_ - tick0_us_ + since_us * (speed_ppm_ / 1000) / 1000;
  }
  if (used_ && room_us < last_us_) {
    const std::int64_t slow_us =
        (server_us - last_server_us_) * (speed_ppm_ / 1000) / (2 * (kFullSpeedPpm / 1000));
    if (slow_us == 0) return last_us_;  // too short a time: it counts with the next call
    room_us = last_us_ + slow_us;
  }
  used_ = true;
  last_us_ = room_us;
  last_server_us_ = server_us;
  return room_us;
}

}  // namespace seam
