#include "common/codec/packed/packing.h"

#include <algorithm>
#include <cmath>

#include "common/codec/quanta.h"

namespace seam {
namespace {

constexpr double kFine = 65536;  // per velocity unit
constexpr std::int64_t kTicksMost = 1024;
/// Angle units per 1/512 rad, times 2^16: 65536 / (2 pi) / 512 * 65536.
constexpr std::int64_t kTurnPerQuantum = 1335088;

std::int64_t Ticks(std::int64_t from, std::int64_t to) {
  return std::clamp<std::int64_t>(to - from, -kTicksMost, kTicksMost);
}

/// Divides and rounds to the nearest, halves up.
std::int64_t Quotient(std::int64_t value, std::int64_t by) {
  const std::int64_t twice = 2 * value + by, whole = twice / (2 * by);
  return whole - (twice % (2 * by) < 0 ? 1 : 0);
}

std::int16_t Low(std::int64_t value) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(value & 0xffff));
}

}  // namespace

PackedContext::PackedContext()
    : calm{NumberModel(50, 6), NumberModel(60, 4), NumberModel(80, 4),
           NumberModel(40, 1), NumberModel(40, 1), NumberModel(40, 2)},
      stirred{NumberModel(15, 6), NumberModel(25, 4), NumberModel(20, 7),
              NumberModel(10, 5), NumberModel(15, 4), NumberModel(10, 7)},
      fresh{NumberModel(20, 9), NumberModel(20, 7), NumberModel(20, 8),
            NumberModel(5, 11), NumberModel(5, 9),  NumberModel(10, 13)} {}

const PackedContext& FreshContext() {
  static const PackedContext context;
  return context;
}

PackedMotion::PackedMotion(float x, float y, int hz) : tick_hz(std::max(1, hz)) {
  const auto fine = [&](float g) {
    const double per_tick = static_cast<double>(g) * kQuantaPerSpeed * kFine / std::max(1, hz);
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
  to.vx = Low(from.vx + Quotient(motion.gravity_x * ticks, static_cast<std::int64_t>(kFine)));
  to.vy = Low(from.vy + Quotient(motion.gravity_y * ticks, static_cast<std::int64_t>(kFine)));
  return to;
}

void PredictPose(const PackedMotion& motion, const WireBody& from, WireBody* to) {
  const std::int64_t ticks = Ticks(from.tick, to->tick);
  // Positions are in 1/512 m and velocities in 1/256 m/s, so the sum of two velocities is their
  // mean in position units per second.
  const auto moved = [&](int v0, int v1) {
    return static_cast<std::uint32_t>(Quotient((v0 + v1) * ticks, motion.tick_hz));
  };
  to->x = from.x + moved(from.vx, to->vx);
  to->y = from.y + moved(from.vy, to->vy);
  const std::int64_t turned =
      Quotient((from.spin + to->spin) * ticks * kTurnPerQuantum, motion.tick_hz * 65536);
  to->angle = Low(from.angle + turned);
}

}  // namespace seam
