/// Corrector: keeps extrapolated bodies from passing through anchored shapes. Ground is often a
/// line; a body below it falls forever, also at its authority once that is this peer.

#include <algorithm>

#include "common/sync/correct/corrector.h"

namespace seam {
namespace {

/// A body that moved less than this cannot have crossed a shape, m.
constexpr float kCrossingMin = 0.05f;
/// A body that is stopped before a surface keeps this share of its smallest half extent as
/// distance; the engine pushes the rest out.
constexpr float kClear = 0.9f;

}  // namespace

/// Returns true if the copy came from its authority's position to its own without crossing an
/// anchored shape.
bool Corrector::CameFrom(int body, const Vec2& heard, std::int64_t from) const {
  const BodyState* before = memory_.ComparablePast(body, from);
  if (before == nullptr || world_.FreeWay(body, heard, before->position) < 1) return false;
  Vec2 at = before->position;
  for (std::int64_t tick = from + 1; tick <= world_.tick(); ++tick) {
    const BodyState* const past = memory_.history().At(tick, body);
    if (past == nullptr || world_.FreeWay(body, at, past->position) < 1) return false;
    at = past->position;
  }
  return world_.FreeWay(body, at, world_.Read(body).position) >= 1;
}

Vec2 Corrector::WayTo(int body, const Vec2& heard, std::int64_t from, const Vec2& target) const {
  if ((target - heard).norm() < kCrossingMin || world_.FreeWay(body, heard, target) >= 1)
    return target;
  // It may have come round a corner: then only its present move counts.
  const Vec2 start = CameFrom(body, heard, from) ? world_.Read(body).position : heard;
  const Vec2 way = target - start;
  const float share = world_.FreeWay(body, start, target), length = way.norm();
  if (share >= 1) return target;
  const auto [low, high] = world_.Bounds(body);
  const float off = kClear * 0.5f * (high - low).minCoeff();
  return start + way * (std::max(0.0f, share * length - off) / length);
}

}  // namespace seam
