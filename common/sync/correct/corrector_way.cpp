/// Corrector: what is moved on by a velocity, or by a difference of long ago, does not go through
/// what is anchored: ground is often a line, and what is below it falls for ever, at its authority
/// too once this peer is that.

#include <algorithm>

#include "common/sync/correct/corrector.h"

namespace seam {
namespace {

/// Nobody is on the other side of anything who has gone no farther than this, m.
constexpr float kNear = 0.05f;
/// What is stopped before a surface keeps off it by this share of its smallest half extent: the
/// engine pushes the rest out.
constexpr float kClear = 0.9f;

}  // namespace

/// Whether the copy is where it is by ways that nothing anchored lies across, from where its
/// authority had it.
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
  if ((target - heard).norm() < kNear || world_.FreeWay(body, heard, target) >= 1) return target;
  // Round a corner it may have come: then only what it is moved by now counts.
  const Vec2 start = CameFrom(body, heard, from) ? world_.Read(body).position : heard;
  const Vec2 way = target - start;
  const float share = world_.FreeWay(body, start, target), length = way.norm();
  if (share >= 1) return target;
  const auto [low, high] = world_.Bounds(body);
  const float off = kClear * 0.5f * (high - low).minCoeff();
  return start + way * (std::max(0.0f, share * length - off) / length);
}

}  // namespace seam
