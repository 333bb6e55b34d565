#include "common/sync/smoother.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"

namespace seam {
namespace {

/// Rate of the critically damped return, 1/s: 0.1 s is its time constant. Faster shows corrections
/// as jerks, slower shows stale poses for longer (measured: docs/lessons.md).
constexpr float kRate = 10;
/// Share of a correction of velocity that the offset takes. All of it hides a collision that our
/// copy only heard of, but what contacts undo at once would show; none shows every velocity jump.
constexpr float kVelocityShare = 0.5f;
/// Speed of the glide, m/s: at least kGlideMin, or kGlideShare of the body's own speed.
constexpr float kGlideMin = 4.0f;
constexpr float kGlideShare = 0.35f;
constexpr float kSpinCap = 6.0f;  // rad/s
/// Beyond this the view jumps: nobody can glide through it without lying for seconds. m
constexpr float kGiveUp = 15.0f;
/// Offsets below these are over: m (rad) and m/s (rad/s).
constexpr float kOver = 1e-5f, kOverSpeed = 1e-4f;

/// One step of a critically damped spring of rate kRate towards zero, exactly.
template <typename T>
void Return(float dt, T* offset, T* velocity) {
  const float decay = std::exp(-kRate * dt);
  const T slope = *velocity + kRate * *offset;
  *offset = (*offset + slope * dt) * decay;
  *velocity = (*velocity - slope * (kRate * dt)) * decay;
}

}  // namespace

Smoother::Smoother(int body_count, bool enabled)
    : enabled_(enabled), offsets_(static_cast<std::size_t>(body_count)) {}

void Smoother::Remap(const std::vector<int>& origins) {
  std::vector<Offset> offsets;
  for (const int from : origins) {
    offsets.push_back(from < 0 ? Offset{} : offsets_[static_cast<std::size_t>(from)]);
  }
  offsets_ = std::move(offsets);
}

void Smoother::Moved(int body, const BodyState& by) {
  if (!enabled_) return;
  Offset& o = offsets_[static_cast<std::size_t>(body)];
  o.position -= by.position;
  o.velocity -= kVelocityShare * by.velocity;
  o.angle = WrapAngle(o.angle - by.angle);
  o.spin -= kVelocityShare * by.spin;
  if (o.position.norm() > kGiveUp) o = Offset{};
}

void Smoother::Reset(int body) { offsets_[static_cast<std::size_t>(body)] = Offset{}; }

void Smoother::Advance(int body, float dt, float speed) {
  Offset& o = offsets_[static_cast<std::size_t>(body)];
  const Vec2 was = o.position;
  Return(dt, &o.position, &o.velocity);
  const Vec2 move = o.position - was;
  const float most = std::max(kGlideMin, kGlideShare * speed) * dt;
  if (move.norm() > most) {
    const Vec2 capped = move * (most / move.norm());
    o.position = was + capped;
    o.velocity = capped / dt;
  }
  if (o.position.norm() < kOver && o.velocity.norm() < kOverSpeed) {
    o.position.setZero();
    o.velocity.setZero();
  }
  const float angle_was = o.angle;
  Return(dt, &o.angle, &o.spin);
  if (std::fabs(o.angle - angle_was) > kSpinCap * dt) {
    o.spin = std::copysign(kSpinCap, o.angle - angle_was);
    o.angle = angle_was + o.spin * dt;
  }
  if (std::fabs(o.angle) < kOver && std::fabs(o.spin) < kOverSpeed) o.angle = o.spin = 0;
}

const Vec2& Smoother::offset(int body) const {
  return offsets_[static_cast<std::size_t>(body)].position;
}

float Smoother::angle_offset(int body) const {
  return offsets_[static_cast<std::size_t>(body)].angle;
}

}  // namespace seam
