#include "server/interest/newest_states.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/base/geometry.h"
#include "common/sync/mode.h"
#include "common/sync/quantize.h"
#include "common/sync/reach/reach.h"
#include "common/sync/state_limits.h"

namespace seam {
namespace {

/// Returns an upper bound of the distance from a body's origin to its farthest point, m.
float ReachOf(const World& world, int body) {
  const MovingBox box = BoxOf(world, body);
  const Vec2 at = world.Read(body).position;
  return (box.max - at).cwiseAbs().cwiseMax((box.min - at).cwiseAbs()).norm();
}

}  // namespace

bool NewestStates::IsNews(const Body& body, const WireBody& told, const ReckoningRule& rule,
                          double repeat_s) const {
  const WireBody& now = body.heard;
  if (told.tick < 0 || told.epoch != now.epoch) return true;
  if (((told.flags ^ now.flags) & kStateAsleep) != 0) return true;
  const float seconds = static_cast<float>(now.tick - told.tick) / static_cast<float>(tick_hz_);
  constexpr float kQuantum = kPositionQuantum, kSpeed = kVelocityQuantum;
  const float speed = kSpeed * static_cast<float>(std::abs(told.vx) + std::abs(told.vy)) +
                      kSpeed * static_cast<float>(std::abs(told.spin)) * body.reach;
  if (seconds >= (speed < kRepeatSlow ? kStateRepeatSlowS : repeat_s)) return true;
  if (seconds < rule.least) return false;
  const auto difference = [](std::uint32_t a, std::uint32_t b) {
    return static_cast<float>(static_cast<std::int32_t>(a - b));
  };
  const float x = difference(now.x, told.x) * kQuantum - seconds * kSpeed * told.vx;
  const float y = difference(now.y, told.y) * kQuantum - seconds * kSpeed * told.vy;
  Vec2 way(x, y);
  if ((told.flags & kStateFalls) != 0) {
    // As the engine integrates: a substep moves by the velocity at its end (Flight).
    const Solver& solver = world_.scene().solver;
    const float step = world_.dt() / static_cast<float>(solver.substeps);
    way -= (seconds * (seconds + step) / 2) * world_.scene().gravity;
  }
  float off = way.norm();
  if (std::abs(static_cast<int>(now.spin)) * kSpeed < kSpinSeen) {
    const auto steps =
        static_cast<std::int16_t>(static_cast<std::uint16_t>(now.angle - told.angle));
    const float turn = static_cast<float>(steps * kAngleQuantum) - seconds * kSpeed * told.spin;
    off += std::fabs(WrapAngle(turn)) * body.reach;
  }
  return off > rule.off;
}

/// `before`: tick of the state before the latest.
bool NewestStates::IsRefresh(const Body& body, std::int64_t before) const {
  const WireBody &now = body.heard, &told = body.followed;
  if (told.tick < 0 || told.epoch != now.epoch) return true;
  if (((told.flags ^ now.flags) & kStateAsleep) != 0) return true;
  const std::int64_t every = RefreshEvery(tick_hz_);
  return now.tick - told.tick >= every || 2 * (now.tick - before) >= every;
}

const std::vector<NewestStates::Told>& NewestStates::Take(const States& states, double repeat_s) {
  const std::size_t count = states.id.size();
  told_.assign(count, Told{});
  const StatesHeader header = HeaderOf(states);
  for (std::size_t i = 0; i < count; ++i) {
    Told& told = told_[i];
    told.body = world_.BodyOfId(states.id[i]);
    if (told.body < 0) continue;
    told.mechanism = world_.mechanism(told.body);
    Body& body = bodies_[told.body];
    body.header = header;
    const std::int64_t before = body.heard.tick;
    body.heard = BodyAt(states, i);
    told.refresh = IsRefresh(body, before);
    if (told.refresh) body.followed = body.heard;
    if (body.reach < 0) body.reach = ReachOf(world_, told.body);
    News& news = together_[told.mechanism];
    if (IsNews(body, body.far, kFarReckoning, repeat_s)) {
      news = News::kAll;
    } else if (news == News::kNobody && IsNews(body, body.near, kNearReckoning, repeat_s)) {
      news = News::kNear;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    Told& told = told_[i];
    if (told.body < 0) continue;
    Body& body = bodies_[told.body];
    told.news = together_[told.mechanism];
    if (told.news >= News::kNear) body.near = body.heard;
    if (told.news == News::kAll) body.far = body.heard;
  }
  for (const Told& told : told_) {
    if (told.body >= 0) together_[told.mechanism] = News::kNobody;
  }
  return told_;
}

}  // namespace seam
