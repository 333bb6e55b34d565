#include "common/stages/bonds/relative_rest.h"

#include <box2d/b2_distance.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/physics/world.h"
#include "common/physics/world_build.h"

namespace seam {
namespace {

using Parts = std::pair<PartId, PartId>;
Parts PartsOf(const NearPair& pair) { return {pair.a, pair.b}; }
bool Before(const NearPair& x, const NearPair& y) { return PartsOf(x) < PartsOf(y); }

/// Overlap above which bodies are being pushed apart, m. The engine leaves bodies at rest
/// overlapping by its slop.
constexpr float kPressedIn = 3 * b2_linearSlop;

/// Returns the middle of the overlap of the two boxes.
b2Vec2 PointOf(b2Contact* contact) {
  const b2AABB& a = contact->GetFixtureA()->GetAABB(contact->GetChildIndexA());
  const b2AABB& b = contact->GetFixtureB()->GetAABB(contact->GetChildIndexB());
  return 0.5f * (b2Max(a.lowerBound, b.lowerBound) + b2Min(a.upperBound, b.upperBound));
}

/// Returns a body's velocity at a point. A prescribed body's velocity is that of its origin.
b2Vec2 VelocityAt(const StageWorld& world, b2Body* body, const b2Vec2& point) {
  const int index = IndexOf(body);
  const bool led =
      index >= 0 && world.activities[static_cast<std::size_t>(index)] == Activity::kPrescribed;
  if (!led) return body->GetLinearVelocityFromWorldPoint(point);
  const b2Vec2 arm = point - body->GetPosition();
  return body->GetLinearVelocity() + b2Cross(body->GetAngularVelocity(), arm);
}

}  // namespace

RelativeMotion MotionAt(const StageWorld& world, b2Contact* contact) {
  b2Body* a = contact->GetFixtureA()->GetBody();
  b2Body* b = contact->GetFixtureB()->GetBody();
  const b2Vec2 point = PointOf(contact);
  const b2Vec2 slip = VelocityAt(world, b, point) - VelocityAt(world, a, point);
  return {slip.Length(), std::fabs(b->GetAngularVelocity() - a->GetAngularVelocity())};
}

bool IsInterpenetrating(b2Contact* contact) {
  if (!contact->IsTouching()) return false;
  b2WorldManifold manifold;
  contact->GetWorldManifold(&manifold);
  const int32 points = contact->GetManifold()->pointCount;
  const float* const apart = manifold.separations;
  return std::any_of(apart, apart + points, [](float gap) { return gap < -kPressedIn; });
}

float GapOf(b2Contact* contact) {
  if (contact->IsTouching()) return 0;
  b2Fixture *const a = contact->GetFixtureA(), *const b = contact->GetFixtureB();
  b2DistanceInput input;
  input.proxyA.Set(a->GetShape(), contact->GetChildIndexA());
  input.proxyB.Set(b->GetShape(), contact->GetChildIndexB());
  input.transformA = a->GetBody()->GetTransform();
  input.transformB = b->GetBody()->GetTransform();
  input.useRadii = true;
  b2SimplexCache cache;
  cache.count = 0;
  b2DistanceOutput output;
  b2Distance(&output, &cache, &input);
  return output.distance;
}

void RestPairs::Count(std::vector<NearPair> now, int limit) {
  std::sort(now.begin(), now.end(), Before);
  std::vector<NearPair> next;
  auto then = pairs_.begin();
  for (const NearPair& pair : now) {
    if (!next.empty() && PartsOf(next.back()) == PartsOf(pair)) {
      next.back().still = next.back().still && pair.still;
      next.back().touching = next.back().touching || pair.touching;
    } else {
      next.push_back(pair);
      while (then != pairs_.end() && Before(*then, pair)) ++then;
      const bool known = then != pairs_.end() && PartsOf(*then) == PartsOf(pair);
      next.back().looks = known ? std::min(then->looks + 1, limit) : 1;
    }
    if (!next.back().still) next.back().looks = 0;
  }
  pairs_ = std::move(next);
}

void RestPairs::Forget(PartId part) {
  for (NearPair& pair : pairs_) {
    if (pair.a == part || pair.b == part) pair.looks = 0;
  }
}

void RestPairs::Save(std::vector<float>* memory) const {
  memory->push_back(static_cast<float>(pairs_.size()));
  for (const NearPair& pair : pairs_) {
    memory->push_back(static_cast<float>(pair.a));
    memory->push_back(static_cast<float>(pair.b));
    memory->push_back(static_cast<float>(pair.looks));
  }
}

void RestPairs::Load(StageMemory* memory) {
  pairs_.assign(memory->NextCount(3), {});
  for (NearPair& pair : pairs_) {
    pair.a = memory->NextInt(0, kStageNumberMax);
    pair.b = memory->NextInt(0, kStageNumberMax);
    pair.looks = memory->NextInt(0, kStageNumberMax);
  }
}

}  // namespace seam
