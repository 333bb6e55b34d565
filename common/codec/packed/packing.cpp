#include "common/codec/packed/packing.h"

#include <algorithm>
#include <cmath>

#include "common/codec/quanta.h"

namespace seam {
namespace {

constexpr std::int64_t kFine = 65536;  // per velocity unit
constexpr std::int64_t kTicksMost = 1024;
/// Angle units per 1/512 rad, times 2^16: 65536 / (2 pi) / 512 * 65536.
constexpr std::int64_t kTurnPerQuantum = 1335088;

std::int64_t Ticks(std::int64_t from, std::int64_t to) {
  return std::clamp<std::int64_t>(to - from, -kTicksMost, kTicksMost);
}

/// Returns a / b rounded to the nearest; halves up. b > 0.
std::int64_t Nearest(std::int64_t a, std::int64_t b) {
  const std::int64_t twice = 2 * a + b, floor = twice / (2 * b);
  return twice % (2 * b) < 0 ? floor - 1 : floor;
}

std::int16_t Low(std::int64_t value) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(value & 0xffff));
}

}  // namespace

PackedMotion::PackedMotion(float x, float y, int hz) : tick_hz(std::max(1, hz)) {
  const auto fine = [&](float g) {
    const double per_tick =
        static_cast<double>(g) * kQuantaPerSpeed * static_cast<double>(kFine) / std::max(1, hz);
    return static_cast<std::int64_t>(std::llround(std::clamp(per_tick, -1e12, 1e12)));
  };
  gravity_x = fine(x);
  gravity_y = fine(y);
}

WireBody PredictVelocity(const PackedMotion& motion, const WireBody& from, std::int64_t tick,
                         bool falls) {
  WireBody to = from;
  to.tick = tick;
  if (!falls) return to;
  const std::int64_t ticks = Ticks(from.tick, tick);
  to.vx = Low(from.vx + Nearest(motion.gravity_x * ticks, kFine));
  to.vy = Low(from.vy + Nearest(motion.gravity_y * ticks, kFine));
  return to;
}

void PredictPose(const PackedMotion& motion, const WireBody& from, WireBody* to) {
  const std::int64_t ticks = Ticks(from.tick, to->tick);
  // Positions are in 1/512 m and velocities in 1/256 m/s, so the sum of two velocities is their
  // mean in position units per second.
  const auto moved = [&](int v0, int v1) {
    return static_cast<std::uint32_t>(Nearest((v0 + v1) * ticks, motion.tick_hz));
  };
  to->x = from.x + moved(from.vx, to->vx);
  to->y = from.y + moved(from.vy, to->vy);
  const std::int64_t turns = (from.spin + to->spin) * ticks * kTurnPerQuantum;
  to->angle = Low(from.angle + Nearest(turns, motion.tick_hz * 65536));
}

PackedModels::PackedModels()
    : steady{NumberModel(.9, 3), NumberModel(.9, 3), NumberModel(.9, 3),
             NumberModel(.7, 1), NumberModel(.7, 1), NumberModel(.4, 2)},
      hit{NumberModel(.2, 6), NumberModel(.2, 6), NumberModel(.3, 6),
          NumberModel(.3, 4), NumberModel(.3, 4), NumberModel(.2, 5)},
      fresh{NumberModel(.4, 9),  NumberModel(.4, 9),  NumberModel(.4, 8),
            NumberModel(.1, 11), NumberModel(.1, 10), NumberModel(.3, 14)},
      first_id(.1, 6),
      id_gap(.3, 2),
      back(.1, 3),
      epoch(.4, 3),
      peer(.5, 2),
      ticks(.8, 1),
      revision(.5, 4),
      base(.1, 3),
      body(.9, 4),
      group(.2, 1),
      same_gap(.8, 2),
      same_back(.8, 2),
      same_rest(.95, 4),
      based(.9, 4),
      falls{BitModel(.2, 1), BitModel(.8, 1)} {}

const PackedModels& PackedModels::Initial() {
  static const PackedModels initial;
  return initial;
}

}  // namespace seam
