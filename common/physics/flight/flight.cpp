#include "common/physics/flight/flight.h"

#include <box2d/b2_distance.h>

#include <algorithm>
#include <cmath>

#include "common/physics/flight/solid.h"

namespace seam {
namespace {

/// Duration of a leg, s. Its path is the chord of a parabola, off by a centimetre at 10 m/s^2.
constexpr float kLeg = 0.1f;
/// Bounces in a leg; a body with more is in a corner, and stays there for the rest of the leg.
constexpr int kBouncesMost = 4;
/// Shapes this near touch, m: resting shapes overlap by the engine's slop, or have a gap of it.
constexpr float kTouch = 2 * b2_linearSlop;
/// A body that leaves a surface more slowly than this rests on it, m/s.
constexpr float kLeaves = 0.1f;

b2DistanceProxy ProxyOf(const b2Fixture& fixture, int child) {
  b2DistanceProxy proxy;
  proxy.Set(fixture.GetShape(), child);
  return proxy;
}

/// True if the point is behind a line that is solid on one side only, from where it is not hit.
bool IsBehind(const b2Fixture& line, int child, const b2Vec2& point) {
  b2EdgeShape edge;
  if (line.GetType() == b2Shape::e_chain) {
    static_cast<const b2ChainShape*>(line.GetShape())->GetChildEdge(&edge, child);
  } else if (line.GetType() == b2Shape::e_edge) {
    edge = *static_cast<const b2EdgeShape*>(line.GetShape());
  } else {
    return false;
  }
  if (!edge.m_oneSided) return false;
  const b2Vec2 along = edge.m_vertex2 - edge.m_vertex1;
  const b2Vec2 local = b2MulT(line.GetBody()->GetTransform(), point);
  return b2Dot(b2Vec2(along.y, -along.x), local - edge.m_vertex1) < 0;
}

/// Visits the shapes in a box.
template <class Visit>
struct InBox {
  const b2BroadPhase& phase;
  const Visit& visit;
  bool QueryCallback(int proxy) const {
    visit(*static_cast<const b2FixtureProxy*>(phase.GetUserData(proxy)));
    return true;
  }
};

}  // namespace

/// State of the centre of mass.
struct Flight::Pose {
  b2Vec2 centre{0, 0}, velocity{0, 0};
  float angle = 0, spin = 0;
};

/// A contact with something anchored. `normal` points away from that.
struct Flight::Contact {
  const b2Fixture* own = nullptr;
  const b2Fixture* other = nullptr;
  b2Vec2 point{0, 0}, normal{0, 0};
  float share = 1;  ///< share of a leg's shift up to the contact
};

void Flight::Begin(const b2World& world, const b2Body& body, const b2MassData& mass, float step_s) {
  world_ = &world;
  body_ = &body;
  centre_ = mass.center;
  mass_ = mass.mass;
  inertia_ = mass.I - mass.mass * mass.center.LengthSquared();
  step_s_ = step_s;
}

/// The engine applies gravity before it moves a body: half a step's fall farther than a parabola.
b2Vec2 Flight::ShiftOf(const Pose& pose, const b2Vec2& pull, float seconds) const {
  return seconds * pose.velocity + (seconds * (seconds + step_s_) / 2) * pull;
}

b2Transform Flight::TransformOf(const Pose& pose) const {
  b2Transform at(b2Vec2(0, 0), b2Rot(pose.angle));
  at.p = pose.centre - b2Mul(at.q, centre_);
  return at;
}

BodyState Flight::After(const BodyState& from, float seconds) {
  Pose at;
  at.angle = from.angle;
  at.spin = from.spin;
  at.velocity.Set(from.velocity.x(), from.velocity.y());
  at.centre = b2Vec2(from.position.x(), from.position.y()) + b2Mul(b2Rot(at.angle), centre_);
  for (; seconds > 0; seconds -= kLeg) Leg(&at, std::min(seconds, kLeg));
  const b2Vec2 origin = TransformOf(at).p;
  return {Vec2(origin.x, origin.y), at.angle, Vec2(at.velocity.x, at.velocity.y), at.spin};
}

void Flight::Leg(Pose* at, float seconds) {
  for (int bounces = 0; bounces <= kBouncesMost && seconds > 0; ++bounces) {
    b2Vec2 pull = body_->GetGravityScale() * world_->GetGravity();
    const b2Transform from = TransformOf(*at);
    FindNear(from, ShiftOf(*at, pull, seconds));
    if (!near_.empty()) pull = HeldBack(at, pull);
    const b2Vec2 shift = ShiftOf(*at, pull, seconds);
    Contact hit;
    const bool hits = !near_.empty() && FirstHit(from, shift, &hit);
    const float passed = hit.share * seconds;
    at->centre += hit.share * shift;
    at->velocity += passed * pull;
    at->angle += passed * at->spin;
    if (hits) Bounce(hit, at);
    seconds = hits ? seconds - passed : 0;
  }
}

void Flight::FindNear(const b2Transform& at, const b2Vec2& shift) {
  near_.clear();
  b2AABB box;
  bool any = false;
  for (const b2Fixture* own = body_->GetFixtureList(); own != nullptr; own = own->GetNext()) {
    for (int child = 0; child < own->GetShape()->GetChildCount(); ++child) {
      b2AABB one;
      own->GetShape()->ComputeAABB(&one, at, child);
      if (any) {
        box.Combine(one);
      } else {
        box = one;
      }
      any = true;
    }
  }
  if (!any) return;
  box.lowerBound += b2Min(shift, b2Vec2(0, 0)) - b2Vec2(kTouch, kTouch);
  box.upperBound += b2Max(shift, b2Vec2(0, 0)) + b2Vec2(kTouch, kTouch);
  const b2BroadPhase& phase = world_->GetContactManager().m_broadPhase;
  const auto take = [this](const b2FixtureProxy& proxy) {
    if (IsSolidAndAnchored(*proxy.fixture)) near_.push_back({proxy.fixture, proxy.childIndex});
  };
  InBox<decltype(take)> in_box{phase, take};
  phase.Query(&in_box, box);
}

/// Visits pairs of shapes that collide.
template <class Visit>
void Flight::EachPair(const Visit& visit) const {
  for (const b2Fixture* own = body_->GetFixtureList(); own != nullptr; own = own->GetNext()) {
    if (own->IsSensor()) continue;
    for (const Near& near : near_) {
      if (!Collide(*own, *near.fixture)) continue;
      for (int child = 0; child < own->GetShape()->GetChildCount(); ++child) {
        visit(*own, child, *near.fixture, near.child);
      }
    }
  }
}

/// Makes the body bounce off shapes that it touches already. Returns `pull` less the parts that
/// they support.
b2Vec2 Flight::HeldBack(Pose* at, const b2Vec2& pull) const {
  b2Vec2 left = pull;
  EachPair([&](const b2Fixture& own, int own_child, const b2Fixture& other, int child) {
    if (IsBehind(other, child, at->centre)) return;
    b2DistanceInput input;
    input.proxyA = ProxyOf(other, child);
    input.proxyB = ProxyOf(own, own_child);
    input.transformA = other.GetBody()->GetTransform();
    input.transformB = TransformOf(*at);
    input.useRadii = false;
    b2SimplexCache cache;
    cache.count = 0;
    b2DistanceOutput output;
    b2Distance(&output, &cache, &input);
    if (output.distance - input.proxyA.m_radius - input.proxyB.m_radius > kTouch) return;
    if (output.distance < b2_epsilon) {  // too deep to find the way out except by the centre
      input.proxyB = b2DistanceProxy();
      input.proxyB.Set(&at->centre, 1, 0);
      input.transformB.SetIdentity();
      cache.count = 0;
      b2Distance(&output, &cache, &input);
      if (output.distance < b2_epsilon) return;
    }
    Contact contact;
    contact.own = &own;
    contact.other = &other;
    contact.point = output.pointA;
    contact.normal = output.pointB - output.pointA;
    contact.normal.Normalize();
    Bounce(contact, at);
    const float into = b2Dot(left, contact.normal);
    if (into < 0 && b2Dot(at->velocity, contact.normal) < kLeaves) left -= into * contact.normal;
  });
  return left;
}

/// Finds the first hit on the straight path. Shapes touched at its beginning are ignored.
bool Flight::FirstHit(const b2Transform& at, const b2Vec2& shift, Contact* hit) const {
  bool any = false;
  EachPair([&](const b2Fixture& own, int own_child, const b2Fixture& other, int child) {
    if (IsBehind(other, child, b2Mul(at, centre_))) return;
    b2ShapeCastInput input;
    input.proxyA = ProxyOf(other, child);
    input.proxyB = ProxyOf(own, own_child);
    input.transformA = other.GetBody()->GetTransform();
    input.transformB = at;
    input.translationB = shift;
    b2ShapeCastOutput output;
    if (!b2ShapeCast(&output, &input) || output.lambda >= hit->share) return;
    if (b2Dot(output.normal, shift) >= 0) return;  // it leaves after a bounce
    *hit = {&own, &other, output.point, output.normal, output.lambda};
    any = true;
  });
  return any;
}

/// Applies an impulse with Coulomb friction at a point, as Box2D's solver computes it.
void Flight::Bounce(const Contact& contact, Pose* at) const {
  const b2Vec2 arm = contact.point - at->centre, normal = contact.normal;
  const b2Vec2 tangent = b2Cross(normal, 1.0f);
  const float into = b2Dot(at->velocity + b2Cross(at->spin, arm), normal);
  if (into >= 0) return;
  const auto push = [&](const b2Vec2& along, float impulse) {
    at->velocity += (impulse / mass_) * along;
    if (inertia_ > 0) at->spin += impulse * b2Cross(arm, along) / inertia_;
  };
  const auto mass = [&](const b2Vec2& along) {
    const float turn = b2Cross(arm, along);
    return 1 / (1 / mass_ + (inertia_ > 0 ? turn * turn / inertia_ : 0));
  };
  const float bounce =
      b2MixRestitution(contact.own->GetRestitution(), contact.other->GetRestitution());
  const float least = b2MixRestitutionThreshold(contact.own->GetRestitutionThreshold(),
                                                contact.other->GetRestitutionThreshold());
  const float impulse = -(into < -least ? 1 + bounce : 1) * into * mass(normal);
  const float grip =
      b2MixFriction(contact.own->GetFriction(), contact.other->GetFriction()) * impulse;
  const float slide = b2Dot(at->velocity + b2Cross(at->spin, arm), tangent);
  push(normal, impulse);
  push(tangent, std::clamp(-slide * mass(tangent), -grip, grip));
}

}  // namespace seam
