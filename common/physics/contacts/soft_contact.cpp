#include "common/physics/contacts/soft_contact.h"

namespace seam {
namespace {

/// Splits the arm from a body's centre to the point in a part that turns with the body, and a part
/// that does not: from the centre of a circle to its rim.
b2Vec2 TurningArm(const b2Fixture* fixture, const b2Body* body, const b2Vec2& arm) {
  if (fixture->GetType() != b2Shape::e_circle) return arm;
  const auto& circle = *static_cast<const b2CircleShape*>(fixture->GetShape());
  return b2Mul(body->GetTransform(), circle.m_p) - body->GetWorldCenter();
}

float MassAlong(const SoftBody& a, const SoftBody& b, const SoftContact::Point& p, float x,
                float y) {
  const float aw = p.ax * y - p.ay * x, bw = p.bx * y - p.by * x;
  const float k = a.im + b.im + a.ii * aw * aw + b.ii * bw * bw;
  return k > 0 ? 1 / k : 0;
}

}  // namespace

void ReadSoftContact(const std::vector<SoftBody>& bodies, SoftContact* contact) {
  b2Contact* const made = contact->made;
  b2Fixture* const fixture_a = made->GetFixtureA();
  b2Fixture* const fixture_b = made->GetFixtureB();
  b2Body* const body_a = fixture_a->GetBody();
  b2Body* const body_b = fixture_b->GetBody();
  const b2Manifold& manifold = *made->GetManifold();
  b2WorldManifold world;
  made->GetWorldManifold(&world);
  contact->count = manifold.pointCount;
  contact->nx = world.normal.x;
  contact->ny = world.normal.y;
  contact->friction = made->GetFriction();
  contact->restitution = made->GetRestitution();
  contact->threshold = made->GetRestitutionThreshold();
  contact->belt = made->GetTangentSpeed();
  const SoftBody& a = bodies[static_cast<std::size_t>(contact->a)];
  const SoftBody& b = bodies[static_cast<std::size_t>(contact->b)];
  for (int i = 0; i < contact->count; ++i) {
    SoftContact::Point& p = contact->point[i];
    p = {};
    const b2Vec2 arm_a = world.points[i] - body_a->GetWorldCenter();
    const b2Vec2 arm_b = world.points[i] - body_b->GetWorldCenter();
    const b2Vec2 turn_a = TurningArm(fixture_a, body_a, arm_a);
    const b2Vec2 turn_b = TurningArm(fixture_b, body_b, arm_b);
    p.ax = arm_a.x;
    p.ay = arm_a.y;
    p.bx = arm_b.x;
    p.by = arm_b.y;
    p.turn_ax = turn_a.x;
    p.turn_ay = turn_a.y;
    p.turn_bx = turn_b.x;
    p.turn_by = turn_b.y;
    // The rims rest as deep in each other as the engine lets them.
    p.apart = world.separations[i] + b2_linearSlop - b2Dot(turn_b - turn_a, world.normal);
    p.mass_n = MassAlong(a, b, p, contact->nx, contact->ny);
    p.mass_t = MassAlong(a, b, p, contact->ny, -contact->nx);
    p.pushed = manifold.points[i].normalImpulse;
    p.rubbed = manifold.points[i].tangentImpulse;
  }
}

}  // namespace seam
