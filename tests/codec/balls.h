#pragma once
/// Balls that fly, bounce and are touched now and then, as states for the codec.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "common/base/random.h"
#include "common/codec/messages.h"

namespace seam {

constexpr int kBallsHz = 60;

/// Balls that fly, bounce and are touched now and then, and a server's States of them.
class Balls {
 public:
  Balls(std::uint64_t seed, double width) : random_(seed) {
    for (int i = 0; i < 60; ++i) {
      balls_.push_back({Within(-width, width), Within(0, 20), Within(-9, 9), 0, Within(-5, 5), 0});
    }
  }
  void Step() {
    ++tick_;
    for (Ball& b : balls_) {
      b.vy -= 10.0 / kBallsHz;
      b.x += b.vx / kBallsHz;
      b.y += b.vy / kBallsHz;
      b.angle += b.spin / kBallsHz;
      if (b.y < 0) b.y = -b.y, b.vy = -b.vy;
      if (random_.Chance(0.005)) b.vx = Within(-100, 100), b.spin = Within(-100, 100);
    }
    if (random_.Chance(0.01)) ++revision_, composition_ = static_cast<std::int64_t>(random_.Next());
  }
  /// States of a `share` of the balls; each peer has twenty.
  std::vector<States> Tell(double share) {
    std::vector<States> all;
    for (std::size_t first = 0; first < balls_.size(); first += 20) {
      States s;
      s.peer = static_cast<std::int32_t>(first / 20);
      s.tick = tick_ - (share < 1 ? static_cast<std::int64_t>(random_.Next() % 3) : 0);
      s.revision = revision_;
      s.composition = composition_;
      s.origin_y = -30;
      for (std::size_t i = first; i < std::min(first + 20, balls_.size()); ++i) {
        if (!random_.Chance(share)) continue;
        const Ball& b = balls_[i];
        if (s.id.empty()) s.origin_x = static_cast<std::int32_t>(b.x);
        if (std::abs(b.x - s.origin_x) > 60) continue;
        s.id.push_back(static_cast<std::int32_t>(7 * i));
        s.epoch.push_back(
            static_cast<std::int32_t>(random_.Chance(0.01) ? random_.Next() >> 33 : i % 5));
        s.flags.push_back(static_cast<std::int8_t>(random_.Chance(0.02) ? 3 : 0));
        s.x.push_back(Low((b.x - s.origin_x) * 512));
        s.y.push_back(Low((b.y - s.origin_y) * 512));
        s.angle.push_back(Low(b.angle * 65536 / 6.283185307));
        s.vx.push_back(Low(b.vx * 256));
        s.vy.push_back(Low(b.vy * 256));
        s.spin.push_back(Low(b.spin * 256));
      }
      if (!s.id.empty()) all.push_back(s);
    }
    return all;
  }
  Random& random() { return random_; }

 private:
  struct Ball {
    double x, y, vx, vy, spin, angle;
  };
  double Within(double low, double high) {
    return low + (high - low) * static_cast<double>(random_.Next() % 100000) * 1e-5;
  }
  static std::int16_t Low(double value) {
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(std::llround(value) & 0xffff));
  }

  Random random_;
  std::int64_t tick_ = 1000;
  std::int32_t revision_ = 0;
  std::int64_t composition_ = 77;
  std::vector<Ball> balls_;
};

}  // namespace seam
