#include "common/sync/quantize.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace seam {
namespace {

/// Returns a coordinate in quanta.
std::uint32_t PositionQuanta(float value) {
  constexpr double kQuantaMax = std::numeric_limits<std::int32_t>::max();
  const double quanta = std::nearbyint(static_cast<double>(value) / kPositionQuantum);
  return static_cast<std::uint32_t>(
      static_cast<std::int32_t>(std::clamp(quanta, -kQuantaMax, kQuantaMax)));
}

std::int16_t SpeedQuanta(float value) {
  constexpr double kSpeedQuantaMax = 127 * kQuantaPerSpeed;
  const double quanta = std::nearbyint(static_cast<double>(value) / kVelocityQuantum);
  return static_cast<std::int16_t>(std::clamp(quanta, -kSpeedQuantaMax, kSpeedQuantaMax));
}

std::int64_t AngleSteps(float angle) {
  return static_cast<std::int64_t>(std::llround(static_cast<double>(angle) / kAngleQuantum));
}

std::int16_t LowBits(std::int64_t steps) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(steps & 0xffff));
}

/// Returns a coordinate in m.
double Metres(std::uint32_t quanta) {
  return static_cast<std::int32_t>(quanta) / static_cast<double>(kQuantaPerMetre);
}

}  // namespace

WireBody Quantise(const BodyState& state) {
  WireBody body;
  body.x = PositionQuanta(state.position.x());
  body.y = PositionQuanta(state.position.y());
  body.angle = LowBits(AngleSteps(state.angle));
  body.vx = SpeedQuanta(state.velocity.x());
  body.vy = SpeedQuanta(state.velocity.y());
  body.spin = SpeedQuanta(state.spin);
  return body;
}

std::vector<States> Pack(const States& header, const std::vector<WireBody>& bodies) {
  std::vector<States> out;
  for (const WireBody& body : bodies) {
    if (out.empty() || !Fits(out.back(), body)) {
      out.push_back(header);
      out.back().origin_x = static_cast<std::int32_t>(std::lround(Metres(body.x)));
      out.back().origin_y = static_cast<std::int32_t>(std::lround(Metres(body.y)));
    }
    AppendBody(body, &out.back());
  }
  return out;
}

BodyState Unpack(const WireBody& body, float near_angle) {
  BodyState out;
  out.position = Vec2(static_cast<float>(Metres(body.x)), static_cast<float>(Metres(body.y)));
  const std::int64_t near_steps = AngleSteps(near_angle);
  const std::int64_t difference = LowBits(body.angle - near_steps);
  out.angle = static_cast<float>(static_cast<double>(near_steps + difference) * kAngleQuantum);
  out.velocity = Vec2(body.vx * kVelocityQuantum, body.vy * kVelocityQuantum);
  out.spin = body.spin * kVelocityQuantum;
  return out;
}

BodyState Unpack(const States& states, std::size_t i, float near_angle) {
  return Unpack(BodyAt(states, i), near_angle);
}

}  // namespace seam
