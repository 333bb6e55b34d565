#include "server/control/drag.h"

#include <algorithm>

#include "common/base/geometry.h"
#include "common/physics/part_places.h"

namespace seam {
namespace {

/// Returns the vector, shortened to a length of at most `most`.
Vec2 AtMost(const Vec2& v, float most) {
  const float length = v.norm();
  return length > most ? Vec2(v * (most / length)) : v;
}

/// Returns the moving body of a part; -1 if it is gone, anchored or moved by the scene.
int MovingBodyOf(const World& world, PartId part) {
  const std::vector<int>& all = world.composition().assembly_of_part;
  if (part < 0 || static_cast<std::size_t>(part) >= all.size()) return -1;
  const int assembly = all[static_cast<std::size_t>(part)];
  if (assembly < 0) return -1;
  const PartId id = world.composition().assemblies[static_cast<std::size_t>(assembly)].id;
  const int body = world.BodyOfId(id);
  return body >= 0 && world.mass_point(body).mass > 0 ? body : -1;
}

}  // namespace

std::optional<PushEdit> DragPush(const World& world, const Grip& grip, float seconds) {
  const int body = MovingBodyOf(world, grip.part);
  if (body < 0) return std::nullopt;
  const Scene& scene = world.scene();
  const BodyState at = world.Read(body), part = PartPose(world, grip.part);
  const MassPoint mass = world.mass_point(body);
  const float m = mass.mass, spin_share = mass.inertia > 0 ? 1 / mass.inertia : 0;
  const Vec2 centre = at.position + Turned(mass.centre, at.angle);
  const Vec2 point = part.position + Turned(grip.point, part.angle);
  const Vec2 margin(kDragMargin, kDragMargin);
  const Vec2 target =
      grip.target.cwiseMax(scene.bounds_min + margin).cwiseMin(scene.bounds_max - margin);
  const float w = 2 * kPiFloat * kDragHz;
  const float k = m * w * w, d = 2 * m * w;
  // The spring draws a far body at half its frequency times the stretch.
  const Vec2 stretch = AtMost(point - target, scene.speed_limit / (2 * w));
  const Vec2 r = point - centre;
  const Vec2 velocity = at.velocity + at.spin * Vec2(-r.y(), r.x());
  const float soft = 1 / (seconds * (d + seconds * k));
  // The symmetric matrix ((a, b), (b, c)) of the inverse mass, with the spring's softness.
  const float a = 1 / m + soft + spin_share * r.y() * r.y();
  const float b = -spin_share * r.x() * r.y();
  const float c = 1 / m + soft + spin_share * r.x() * r.x();
  const Vec2 due = velocity + stretch * (k / (d + seconds * k));
  const Vec2 solved = Vec2(c * due.x() - b * due.y(), a * due.y() - b * due.x()) / (b * b - a * c);
  const Vec2 impulse = AtMost(solved, seconds * kDragForcePerKg * m);
  return PushEdit{grip.part, impulse, Cross(r, impulse)};
}

}  // namespace seam
