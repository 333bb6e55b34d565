#include "common/sync/smoother.h"

#include <algorithm>
#include <cmath>

namespace seam {
namespace {

// Share kept per 1/60 s. Nearer to 1 hides longer and shows stale poses for longer.
constexpr float kKeepSmall = 0.95f;   // offsets up to kSmall
constexpr float kKeepLarge = 0.85f;   // offsets from kLarge on
constexpr float kSmall = 0.25f;       // m
constexpr float kLarge = 1.0f;        // m
// Speed of the glide, m/s: at least kGlideMin, or kGlideShare of the body's own speed.
constexpr float kGlideMin = 4.0f;
constexpr float kGlideShare = 0.35f;
// Beyond this the view jumps: nobody can glide through it without lying for seconds. m
constexpr float kGiveUp = 15.0f;
constexpr float kSpinCap = 6.0f;      // rad/s

float Keep(float size) {
  const float t = std::clamp((size - kSmall) / (kLarge - kSmall), 0.0f, 1.0f);
  return kKeepSmall + t * (kKeepLarge - kKeepSmall);
}

}  // namespace

Smoother::Smoother(int body_count, bool enabled)
    : enabled_(enabled), offsets_(static_cast<std::size_t>(body_count)) {}

void Smoother::Moved(int body, const Vec2& by, float by_angle) {
  if (!enabled_) return;
  Offset& o = offsets_[static_cast<std::size_t>(body)];
  o.position -= by;
  o.angle -= by_angle;
  if (o.position.norm() > kGiveUp) o = Offset{};
  o.angle = std::remainder(o.angle, 6.2831853f);
}

void Smoother::Reset(int body) { offsets_[static_cast<std::size_t>(body)] = Offset{}; }

void Smoother::Advance(int body, float dt, float speed) {
  Offset& o = offsets_[static_cast<std::size_t>(body)];
  const float frames = dt * 60;
  const float size = o.position.norm();
  if (size > 0) {
    const float step = size * (1 - std::pow(Keep(size), frames));
    const float cap = std::max(kGlideMin, kGlideShare * speed) * dt;
    o.position *= 1 - std::min(step, cap) / size;
    if (size < 1e-5f) o.position.setZero();
  }
  const float turn = std::fabs(o.angle);
  if (turn > 0) {
    const float step = turn * (1 - std::pow(Keep(turn), frames));
    o.angle *= 1 - std::min(step, kSpinCap * dt) / turn;
    if (turn < 1e-5f) o.angle = 0;
  }
}

const Vec2& Smoother::offset(int body) const {
  return offsets_[static_cast<std::size_t>(body)].position;
}

float Smoother::angle_offset(int body) const {
  return offsets_[static_cast<std::size_t>(body)].angle;
}

}  // namespace seam
