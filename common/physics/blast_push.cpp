#include "common/physics/blast_push.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/base/trig.h"
#include "common/physics/stage.h"
#include "common/physics/world_shapes.h"
#include "common/scene/bricks.h"
#include "common/scene/scene_limits.h"
#include "common/topology/feather_blast.h"

namespace seam {
namespace {

constexpr float kRayGap = 0.06f;  // m, between rays at the radius
constexpr int kRaysMin = 128, kRaysMax = 1024;
/// A hit nearer than this, m, has no direction.
constexpr float kNearMin = 1e-3f;
constexpr float kFullTurn = 2 * kPiFloat;  // rad

/// The rays of a blast, each with its length up to the first brick.
class Fan {
 public:
  explicit Fan(const BlastEdit& blast)
      : blast_(blast),
        count_(std::clamp(static_cast<int>(std::ceil(kFullTurn * blast.radius / kRayGap)), kRaysMin,
                          kRaysMax)),
        reach_(static_cast<std::size_t>(count_), blast.radius) {}

  int count() const { return count_; }
  float reach(int ray) const { return reach_[static_cast<std::size_t>(ray)]; }
  float width() const { return kFullTurn / static_cast<float>(count_); }  ///< rad
  b2Vec2 Direction(int ray) const {
    const float angle = (static_cast<float>(ray) + 0.5f) * width();
    return {Cos(angle), Sin(angle)};
  }

  /// Shortens the rays that meet the box, unless the centre is in it.
  void Cover(const b2Vec2& lower, const b2Vec2& upper) {
    EachEntry(lower, upper, [this](int ray, float enter) {
      float& reach = reach_[static_cast<std::size_t>(ray)];
      reach = std::min(reach, enter);
    });
  }

  /// Calls visit(ray, distance, m) for the rays that meet the box, unless the centre is in it.
  template <typename Visit>
  void EachEntry(const b2Vec2& lower, const b2Vec2& upper, const Visit& visit) const {
    const b2Vec2 centre(blast_.centre.x(), blast_.centre.y());
    const b2Vec2 low = lower - centre, high = upper - centre;
    if (low.x < 0 && low.y < 0 && high.x > 0 && high.y > 0) return;
    // Seen from outside, a box covers less than half a turn.
    const float middle = std::atan2(low.y + high.y, low.x + high.x);
    float from = 0, to = 0;
    for (const b2Vec2& corner : {low, high, b2Vec2(low.x, high.y), b2Vec2(high.x, low.y)}) {
      const float off = WrapAngle(std::atan2(corner.y, corner.x) - middle);
      from = std::min(from, off);
      to = std::max(to, off);
    }
    const int first = static_cast<int>(std::floor((middle + from) / width())) - 1;
    const int last = static_cast<int>(std::ceil((middle + to) / width())) + 1;
    for (int at = first; at <= last; ++at) {
      const int ray = (at + 2 * count_) % count_;
      const float enter = Entry(ray, low, high);
      if (enter < blast_.radius) visit(ray, enter);
    }
  }

 private:
  /// Returns the distance at which the ray enters the box (slab test), m; the radius if it misses.
  float Entry(int ray, const b2Vec2& low, const b2Vec2& high) const {
    const b2Vec2 along = Direction(ray);
    float enter = 0, leave = blast_.radius;
    for (const int axis : {0, 1}) {
      const float way = along(axis);
      if (std::fabs(way) < 1e-6f) {
        if (low(axis) > 0 || high(axis) < 0) return blast_.radius;
        continue;
      }
      const float one = low(axis) / way, other = high(axis) / way;
      enter = std::max(enter, std::min(one, other));
      leave = std::min(leave, std::max(one, other));
    }
    return enter <= leave ? enter : blast_.radius;
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

/// Pieces that the blast has just freed and that still lie in their bricks' places. They are
/// smaller than their bricks (kFreedGap); for a blast they have the bricks' size.
class Rooms : public b2QueryCallback {
 public:
  Rooms(const b2World& world, const Scene& scene, const Fan& fan, const BlastEdit& blast)
      : scene_(scene), rays_(static_cast<std::size_t>(fan.count()), {nullptr, blast.radius}) {
    if (scene.bricks.empty()) return;
    const b2Vec2 half(blast.radius, blast.radius), centre(blast.centre.x(), blast.centre.y());
    b2AABB near;
    near.lowerBound = centre - half;
    near.upperBound = centre + half;
    world.QueryAABB(this, near);
    std::sort(pieces_.begin(), pieces_.end(),
              [](b2Fixture* a, b2Fixture* b) { return PartOf(a) < PartOf(b); });
    for (b2Fixture* piece : pieces_) {
      const Part& part = scene.parts[PartOf(piece)];
      const b2Vec2 at(part.position.x(), part.position.y());
      const b2Vec2 room(part.size.x() / 2 + kFreedGap, part.size.y() / 2 + kFreedGap);
      fan.EachEntry(at - room, at + room, [&](int ray, float enter) {
        Ray& nearest = rays_[static_cast<std::size_t>(ray)];
        if (enter < nearest.enter) nearest = {piece, enter};
      });
    }
  }

  bool ReportFixture(b2Fixture* fixture) override {
    if (IsPiece(*fixture)) pieces_.push_back(fixture);
    return true;
  }

  /// Returns the piece that the ray meets before that distance, m; nullptr if none, or if `hit` is
  /// a piece.
  b2Fixture* Before(int ray, float distance, const b2Fixture* hit) const {
    const Ray& nearest = rays_[static_cast<std::size_t>(ray)];
    return nearest.enter >= distance || (hit != nullptr && IsPiece(*hit)) ? nullptr : nearest.piece;
  }
  float Entry(int ray) const { return rays_[static_cast<std::size_t>(ray)].enter; }

 private:
  struct Ray {
    b2Fixture* piece = nullptr;  // the first on the ray
    float enter = 0;             // m
  };
  bool IsPiece(const b2Fixture& fixture) const {
    const std::uint32_t id = PartOf(&fixture);
    if (id >= scene_.parts.size()) return false;
    const Part& part = scene_.parts[id];
    const b2Body& body = *const_cast<b2Fixture&>(fixture).GetBody();
    return body.GetPosition() == b2Vec2(part.position.x(), part.position.y()) &&
           body.GetAngle() == 0 && part.angle == 0 && part.name.find('@') != std::string::npos;
  }

  const Scene& scene_;
  std::vector<b2Fixture*> pieces_;
  std::vector<Ray> rays_;
};

/// Finds the first shape on a ray; of two at the same distance the one with the lower number, so
/// that the engine's order of search does not matter.
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

std::vector<BlastHit> HitsOf(const b2World& world, const Scene& scene, const FeatherStore& bricks,
                             const BlastEdit& blast) {
  Fan fan(blast);
  CoverByBricks(bricks, blast, &fan);
  const Rooms rooms(world, scene, fan, blast);
  const b2Vec2 centre(blast.centre.x(), blast.centre.y());
  std::vector<BlastHit> hits;
  for (int ray = 0; ray < fan.count(); ++ray) {
    const float reach = fan.reach(ray);
    if (reach < kNearMin) continue;
    const b2Vec2 along = fan.Direction(ray);
    First first;
    world.RayCast(&first, centre, centre + reach * along);
    float distance = first.at * reach;
    if (b2Fixture* piece = rooms.Before(ray, distance, first.hit)) {
      first.hit = piece;
      distance = rooms.Entry(ray);
      first.where = centre + distance * along;
    }
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
