/// SoftContacts: reads contacts of the engine into lanes of blocks.

#include <algorithm>

#include "common/physics/contacts/soft_solve.h"

namespace seam {
namespace {

/// Arm of a point, and the part of it that turns with the body: the surface of a circle does not.
struct Arm {
  b2Vec2 whole, turning;
};

Arm ArmOf(const b2Fixture* fixture, const b2Body* body, const b2Vec2& point) {
  const b2Vec2 whole = point - body->GetWorldCenter();
  if (fixture->GetType() != b2Shape::e_circle) return {whole, whole};
  const auto& circle = *static_cast<const b2CircleShape*>(fixture->GetShape());
  return {whole, b2Mul(body->GetTransform(), circle.m_p) - body->GetWorldCenter()};
}

/// As b2WorldManifold::Initialize, which is compiled elsewhere.
struct WorldPoints {
  b2Vec2 normal = {1, 0};
  b2Vec2 points[b2_maxManifoldPoints];
  float separations[b2_maxManifoldPoints];

  WorldPoints(const b2Manifold& manifold, const b2Transform& a, float radius_a,
              const b2Transform& b, float radius_b) {
    if (manifold.type == b2Manifold::e_circles) {
      const b2Vec2 from = b2Mul(a, manifold.localPoint);
      const b2Vec2 to = b2Mul(b, manifold.points[0].localPoint);
      if (b2DistanceSquared(from, to) > b2_epsilon * b2_epsilon) {
        normal = to - from;
        normal.Normalize();
      }
      Set(0, from + radius_a * normal, to - radius_b * normal);
      return;
    }
    // The face's sign: the normal leads from A to B.
    const bool of_a = manifold.type == b2Manifold::e_faceA;
    const b2Transform &face = of_a ? a : b, &other = of_a ? b : a;
    const float radius_face = of_a ? radius_a : radius_b, radius = of_a ? radius_b : radius_a;
    const b2Vec2 out = b2Mul(face.q, manifold.localNormal);
    const b2Vec2 on = b2Mul(face, manifold.localPoint);
    normal = of_a ? out : -out;
    for (int i = 0; i < manifold.pointCount; ++i) {
      const b2Vec2 clip = b2Mul(other, manifold.points[i].localPoint);
      const b2Vec2 near = clip + (radius_face - b2Dot(clip - on, out)) * out;
      const b2Vec2 far = clip - radius * out;
      Set(i, of_a ? near : far, of_a ? far : near);
    }
  }

 private:
  void Set(int i, b2Vec2 at_a, b2Vec2 at_b) {
    points[i] = 0.5f * (at_a + at_b);
    separations[i] = b2Dot(at_b - at_a, normal);
  }
};

}  // namespace

void SoftContacts::Put(const SoftContact& contact) {
  Block& block = blocks_[static_cast<std::size_t>(contact.lane / kBlockLanes)];
  const int lane = contact.lane % kBlockLanes;
  b2Contact* const made = contact.made;
  const b2Fixture* const fixture_a = made->GetFixtureA();
  const b2Fixture* const fixture_b = made->GetFixtureB();
  const b2Body* const body_a = fixture_a->GetBody();
  const b2Body* const body_b = fixture_b->GetBody();
  const b2Manifold& manifold = *made->GetManifold();
  const WorldPoints world(manifold, body_a->GetTransform(), fixture_a->GetShape()->m_radius,
                          body_b->GetTransform(), fixture_b->GetShape()->m_radius);
  const SoftBody& a = bodies[static_cast<std::size_t>(contact.a)];
  const SoftBody& b = bodies[static_cast<std::size_t>(contact.b)];
  const float restitution = made->GetRestitution();
  const b2Vec2 normal = world.normal;
  block.a[lane] = contact.a;
  block.b[lane] = contact.b;
  block.count = std::max(block.count, manifold.pointCount);
  block.returns = block.returns || restitution > 0;
  returns_ = returns_ || restitution > 0;
  block.nx[lane] = normal.x;
  block.ny[lane] = normal.y;
  block.friction[lane] = made->GetFriction();
  block.belt[lane] = made->GetTangentSpeed();
  block.restitution[lane] = restitution;
  block.threshold[lane] = made->GetRestitutionThreshold();
  block.im_a[lane] = a.im;
  block.ii_a[lane] = a.ii;
  block.im_b[lane] = b.im;
  block.ii_b[lane] = b.ii;
  const Softness& soft = a.im > 0 && b.im > 0 ? soft_ : stiff_;
  block.bias_rate[lane] = soft.bias_rate;
  block.mass_scale[lane] = soft.mass_scale;
  block.impulse_scale[lane] = soft.impulse_scale;
  for (int i = 0; i < manifold.pointCount; ++i) {
    Points& p = block.point[i];
    const Arm arm_a = ArmOf(fixture_a, body_a, world.points[i]);
    const Arm arm_b = ArmOf(fixture_b, body_b, world.points[i]);
    p.lever_an[lane] = b2Cross(arm_a.whole, normal);
    p.lever_bn[lane] = b2Cross(arm_b.whole, normal);
    p.lever_at[lane] = -b2Dot(arm_a.whole, normal);
    p.lever_bt[lane] = -b2Dot(arm_b.whole, normal);
    p.turn_an[lane] = b2Dot(arm_a.turning, normal);
    p.turn_ac[lane] = b2Cross(arm_a.turning, normal);
    p.turn_bn[lane] = b2Dot(arm_b.turning, normal);
    p.turn_bc[lane] = b2Cross(arm_b.turning, normal);
    // The rims rest as deep in each other as the engine lets them.
    p.apart[lane] = world.separations[i] + b2_linearSlop - (p.turn_bn[lane] - p.turn_an[lane]);
    p.pushed[lane] = manifold.points[i].normalImpulse;
    p.rubbed[lane] = manifold.points[i].tangentImpulse;
    p.used[lane] = 1;
  }
}

float SoftContacts::Take(const SoftContact& contact, b2ContactImpulse* impulse) const {
  const Block& block = blocks_[static_cast<std::size_t>(contact.lane / kBlockLanes)];
  const int lane = contact.lane % kBlockLanes;
  b2Manifold& manifold = *contact.made->GetManifold();
  impulse->count = manifold.pointCount;
  float sum = 0;
  for (int i = 0; i < manifold.pointCount; ++i) {
    const Points& p = block.point[i];
    manifold.points[i].normalImpulse = parts_ * p.pushed[lane];
    manifold.points[i].tangentImpulse = parts_ * p.rubbed[lane];
    impulse->normalImpulses[i] = p.sum_n[lane];
    impulse->tangentImpulses[i] = p.sum_t[lane];
    sum += p.sum_n[lane];
  }
  return sum;
}

}  // namespace seam
