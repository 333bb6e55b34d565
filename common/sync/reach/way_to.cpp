#include "common/sync/reach/way_to.h"

#include <algorithm>

namespace seam {
namespace {

/// A body that moved less than this cannot have crossed a shape, m.
constexpr float kCrossingMin = 0.05f;
/// A body that is stopped before a surface keeps this share of its smallest half extent as
/// distance; the engine pushes the rest out.
constexpr float kClear = 0.9f;

/// Returns true if the copy came from its authority's position to its own without crossing an
/// anchored shape.
bool CameFrom(const World& world, const BodyMemory& memory, int body, const Vec2& heard,
              std::int64_t from) {
  const BodyState* before = memory.ComparablePast(body, from);
  if (before == nullptr || world.FreeWay(body, heard, before->position) < 1) return false;
  Vec2 at = before->position;
  for (std::int64_t tick = from + 1; tick <= world.tick(); ++tick) {
    const BodyState* const past = memory.history().At(tick, body);
    if (past == nullptr || world.FreeWay(body, at, past->position) < 1) return false;
    at = past->position;
  }
  return world.FreeWay(body, at, world.Read(body).position) >= 1;
}

}  // namespace

Vec2 WayTo(const World& world, const BodyMemory& memory, int body, const Vec2& heard,
           std::int64_t from, const Vec2& target) {
  if ((target - heard).norm() < kCrossingMin || world.FreeWay(body, heard, target) >= 1)
    return target;
  // It may have come round a corner: then only its present move counts.
  const Vec2 start = CameFrom(world, memory, body, heard, from) ? world.Read(body).position : heard;
  const Vec2 way = target - start;
  const float share = world.FreeWay(body, start, target), length = way.norm();
  if (share >= 1) return target;
  const auto [low, high] = world.Bounds(body);
  const float off = kClear * 0.5f * (high - low).minCoeff();
  return start + way * (std::max(0.0f, share * length - off) / length);
}

}  // namespace seam
