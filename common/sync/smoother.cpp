#include "common/sync/smoother.h"

#include <algorithm>

#include "common/base/geometry.h"

namespace seam {
namespace {

/// Share of a velocity correction that the offset takes. A full share hides a collision that our
/// copy only heard of, but also shows corrections that contacts undo at once; zero shows every
/// velocity jump.
constexpr float kVelocityShare = 0.5f;

}  // namespace

Smoother::Smoother(const BodyTable& table, float rate)
    : rate_(rate), offsets_(table, BodyRule::kOrigin) {}

void Smoother::Moved(int body, const BodyState& by) {
  if (rate_ <= 0) return;
  VisualOffset& o = At(body);
  o.position -= by.position;
  o.velocity -= kVelocityShare * by.velocity;
  o.angle = WrapAngle(o.angle - by.angle);
  o.spin -= kVelocityShare * by.spin;
}

void Smoother::Set(int body, const BodyState& beside) {
  if (rate_ <= 0) return;
  At(body).position = beside.position;
  At(body).angle = WrapAngle(beside.angle);
}

void Smoother::Reset(int body) { At(body) = VisualOffset{}; }

void Smoother::AdvanceTogether(const World& world, const std::vector<int>& bodies,
                               const std::function<BodyState(int)>& base, bool gentle) {
  if (std::all_of(bodies.begin(), bodies.end(), [&](int body) { return At(body).zero(); })) return;
  std::vector<OffsetBody> together;
  together.reserve(bodies.size());
  for (const int body : bodies) {
    together.push_back({world.mass_point(body), base(body), &At(body)});
  }
  ReturnTogether(world.dt(), rate_, together, gentle);
}

const Vec2& Smoother::offset(int body) const { return offsets_[body].position; }

float Smoother::angle_offset(int body) const { return offsets_[body].angle; }

}  // namespace seam
