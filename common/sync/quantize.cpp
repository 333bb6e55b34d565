#include "common/sync/quantize.h"

#include <algorithm>
#include <cmath>

namespace seam {
namespace {

float RoundTo(float value, float quantum) {
  return static_cast<float>(std::nearbyint(static_cast<double>(value) / quantum) * quantum);
}

std::int16_t ToInt16(double value) {
  return static_cast<std::int16_t>(std::clamp(value, -32767.0, 32767.0));
}

float ClampedVelocity(float value) {
  return std::clamp(RoundTo(value, kVelocityQuantum), -127.0f, 127.0f);
}

std::int64_t AngleSteps(float angle) {
  return static_cast<std::int64_t>(std::llround(static_cast<double>(angle) / kAngleQuantum));
}

std::int16_t LowBits(std::int64_t steps) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(steps & 0xffff));
}

}  // namespace

BodyState Quantised(const BodyState& state) {
  BodyState out;
  out.position = Vec2(RoundTo(state.position.x(), kPositionQuantum),
                      RoundTo(state.position.y(), kPositionQuantum));
  out.angle = static_cast<float>(static_cast<double>(AngleSteps(state.angle)) * kAngleQuantum);
  out.velocity = Vec2(ClampedVelocity(state.velocity.x()), ClampedVelocity(state.velocity.y()));
  out.spin = ClampedVelocity(state.spin);
  return out;
}

std::vector<States> Pack(const States& header, const std::vector<PackedBody>& bodies) {
  std::vector<States> out;
  for (const PackedBody& body : bodies) {
    const BodyState q = Quantised(body.state);
    const bool fits = !out.empty() && out.back().id.size() < kStatesBodiesMax &&
                      std::fabs(q.position.x() - static_cast<float>(out.back().origin_x)) <
                          static_cast<float>(kOriginReach) &&
                      std::fabs(q.position.y() - static_cast<float>(out.back().origin_y)) <
                          static_cast<float>(kOriginReach);
    if (!fits) {
      out.push_back(header);
      out.back().origin_x = static_cast<std::int32_t>(std::lround(q.position.x()));
      out.back().origin_y = static_cast<std::int32_t>(std::lround(q.position.y()));
    }
    States& s = out.back();
    s.id.push_back(body.id);
    s.epoch.push_back(body.epoch);
    s.flags.push_back(body.flags);
    s.x.push_back(ToInt16((static_cast<double>(q.position.x()) - s.origin_x) * kQuantaPerMetre));
    s.y.push_back(ToInt16((static_cast<double>(q.position.y()) - s.origin_y) * kQuantaPerMetre));
    s.angle.push_back(LowBits(AngleSteps(q.angle)));
    s.vx.push_back(ToInt16(static_cast<double>(q.velocity.x()) * kQuantaPerSpeed));
    s.vy.push_back(ToInt16(static_cast<double>(q.velocity.y()) * kQuantaPerSpeed));
    s.spin.push_back(ToInt16(static_cast<double>(q.spin) * kQuantaPerSpeed));
  }
  return out;
}

BodyState Unpack(const States& s, std::size_t i, float near_angle) {
  BodyState out;
  out.position =
      Vec2(static_cast<float>(s.origin_x + s.x[i] / static_cast<double>(kQuantaPerMetre)),
           static_cast<float>(s.origin_y + s.y[i] / static_cast<double>(kQuantaPerMetre)));
  const std::int64_t near_steps = AngleSteps(near_angle);
  const std::int64_t difference = LowBits(s.angle[i] - near_steps);
  out.angle = static_cast<float>(static_cast<double>(near_steps + difference) * kAngleQuantum);
  out.velocity = Vec2(s.vx[i] * kVelocityQuantum, s.vy[i] * kVelocityQuantum);
  out.spin = s.spin[i] * kVelocityQuantum;
  return out;
}

}  // namespace seam
