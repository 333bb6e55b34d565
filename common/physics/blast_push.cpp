#include "common/physics/blast_push.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/physics/stage.h"
#include "common/physics/world_shapes.h"
#include "common/scene/bricks.h"
#include "common/scene/scene_limits.h"

namespace seam {
namespace {

constexpr float kRayGap = 0.06f;  // m, between rays at the radius
constexpr int kRaysMin = 128, kRaysMax = 1024;
/// What is nearer than this, m, has no direction.
constexpr float kNearMin = 1e-3f;
constexpr float kTurn = 6.2831853f;  // rad

/// The rays of a blast, and how far bricks let each of them go.
class Fan {
 public:
  explicit Fan(const BlastEdit& blast)
      : blast_(blast),
        count_(std::clamp(static_cast<int>(std::ceil(kTurn * blast.radius / kRayGap)), kRaysMin,
                          kRaysMax)),
        reach_(static_cast<std::size_t>(count_), blast.radius) {}

  int count() const { return count_; }
  float reach(int ray) const { return reach_[static_cast<std::size_t>(ray)]; }
  float width() const { return kTurn / static_cast<float>(count_); }  ///< rad
  b2Vec2 Direction(int ray) const {
    const float angle = (static_cast<float>(ray) + 0.5f) * width();
    return {std::cos(angle), std::sin(angle)};
  }

  /// Shortens the rays that meet the box, unless the centre is in it.
  void Cover(const b2Vec2& lower, const b2Vec2& upper) {
    const b2Vec2 centre(blast_.centre.x(), blast_.centre.y());
    const b2Vec2 low = lower - centre, high = upper - centre;
    if (low.x < 0 && low.y < 0 && high.x > 0 && high.y > 0) return;
    // Seen from outside, a box is less than half a turn wide.
    const float middle = std::atan2(low.y + high.y, low.x + high.x);
    float from = 0, to = 0;
    for (const b2Vec2& corner : {low, high, b2Vec2(low.x, high.y), b2Vec2(high.x, low.y)}) {
      const float off = WrapAngle(std::atan2(corner.y, corner.x) - middle);
      from = std::min(from, off);
      to = std::max(to, off);
    }
    const int first = static_cast<int>(std::floor((middle + from) / width())) - 1;
    const int last = static_cast<int>(std::ceil((middle + to) / width())) + 1;
    for (int ray = first; ray <= last; ++ray) Shorten((ray + 2 * count_) % count_, low, high);
  }

 private:
  /// Where the ray enters the box, by its two pairs of sides.
  void Shorten(int ray, const b2Vec2& low, const b2Vec2& high) {
    const b2Vec2 along = Direction(ray);
    float enter = 0, leave = blast_.radius;
    for (const int axis : {0, 1}) {
      const float way = along(axis);
      if (std::fabs(way) < 1e-6f) {
        if (low(axis) > 0 || high(axis) < 0) return;
        continue;
      }
      const float one = low(axis) / way, other = high(axis) / way;
      enter = std::max(enter, std::min(one, other));
      leave = std::min(leave, std::max(one, other));
    }
    float& reach = reach_[static_cast<std::size_t>(ray)];
    if (enter <= leave) reach = std::min(reach, enter);
  }

  const BlastEdit& blast_;
  int count_;
  std::vector<float> reach_;  // m, by ray
};

void CoverByBricks(const FeatherStore& bricks, const BlastEdit& blast, Fan* fan) {
  if (bricks.size() == 0) return;
  const auto unit = [](float metres) { return static_cast<int>(std::floor(metres / kBrickUnit)); };
  const Vec2 low = blast.centre.array() - blast.radius, high = blast.centre.array() + blast.radius;
  const std::vector<Brick> near =
      bricks.InBox(unit(low.x()), unit(low.y()), unit(high.x()) + 1, unit(high.y()) + 1);
  for (const Brick& b : near) {
    const BrickKind& kind = bricks.kinds()[static_cast<std::size_t>(b.kind)];
    const auto metres = [](int units) { return static_cast<float>(units) * kBrickUnit; };
    fan->Cover({metres(b.x), metres(b.y)}, {metres(b.x + kind.width), metres(b.y + kind.height)});
  }
}

/// The first shape on a ray; of two that begin at one point that of the lower number, so that the
/// order in which the engine looks does not count.
class First : public b2RayCastCallback {
 public:
  float ReportFixture(b2Fixture* fixture, const b2Vec2& point, const b2Vec2& /*normal*/,
                      float fraction) override {
    if (fixture->IsSensor() || PartOf(fixture) >= kStageFixture) return -1;
    const bool same = hit != nullptr && fraction == at;
    if (same && Number(*hit) <= Number(*fixture)) return fraction;
    hit = fixture;
    where = point;
    at = fraction;
    return fraction;
  }

  b2Fixture* hit = nullptr;
  b2Vec2 where{0, 0};
  float at = 1;

 private:
  static std::uintptr_t Number(b2Fixture& fixture) { return fixture.GetUserData().pointer; }
};

}  // namespace

std::vector<BlastHit> HitsOf(const b2World& world, const FeatherStore& bricks,
                             const BlastEdit& blast) {
  Fan fan(blast);
  CoverByBricks(bricks, blast, &fan);
  const b2Vec2 centre(blast.centre.x(), blast.centre.y());
  std::vector<BlastHit> hits;
  for (int ray = 0; ray < fan.count(); ++ray) {
    const float reach = fan.reach(ray);
    if (reach < kNearMin) continue;
    const b2Vec2 along = fan.Direction(ray);
    First first;
    world.RayCast(&first, centre, centre + reach * along);
    const float distance = first.at * reach;
    if (first.hit == nullptr || distance < kNearMin) continue;
    const float silhouette = distance * fan.width();
    const float push = blast.impulse * (1 - distance / blast.radius) * silhouette;
    hits.push_back({first.hit, first.where, push * along});
  }
  return hits;
}

void PushAway(const std::vector<BlastHit>& hits, float speed_limit) {
  for (const BlastHit& hit : hits) {
    b2Body* body = hit.fixture->GetBody();
    if (body->GetType() != b2_dynamicBody) continue;
    body->ApplyLinearImpulse(hit.impulse, hit.point, true);
  }
  for (const BlastHit& hit : hits) {
    b2Body* body = hit.fixture->GetBody();
    if (body->GetType() != b2_dynamicBody) continue;
    const b2Vec2 velocity = body->GetLinearVelocity();
    const float speed = velocity.Length();
    if (speed > speed_limit) body->SetLinearVelocity(speed_limit / speed * velocity);
    body->SetAngularVelocity(std::clamp(body->GetAngularVelocity(), -kSpinMax, kSpinMax));
  }
}

}  // namespace seam
