#include "common/physics/contacts/soft_contact.h"

#include <algorithm>
#include <cmath>

#include "common/physics/exact/engine_members.h"

namespace seam {
namespace {

/// Hz and 1: stiffness and damping ratio of a contact. A contact with something fixed is twice as
/// stiff (Catto, "Solver2D", 2024).
constexpr float kContactHz = 60, kContactDamping = 10, kFixedStiffer = 2;
/// Share of a substep's rate that the stiffness may have at most.
constexpr float kRateShare = 0.25f;
/// m/s: at most so fast is an overlap undone.
constexpr float kPushOutMost = 3;

Softness SoftnessOf(float hz, float h) {
  const float omega = 2 * b2_pi * hz;
  const float a1 = 2 * kContactDamping + h * omega;
  const float a2 = h * omega * a1;
  const float a3 = 1 / (1 + a2);
  return {omega / a1, a2 * a3, a3};
}

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

[[gnu::always_inline]] inline void Apply(const SoftContact::Point& p, float x, float y, SoftBody* a, SoftBody* b) {
  a->vx -= a->im * x;
  a->vy -= a->im * y;
  a->w -= a->ii * (p.ax * y - p.ay * x);
  b->vx += b->im * x;
  b->vy += b->im * y;
  b->w += b->ii * (p.bx * y - p.by * x);
}

[[gnu::always_inline]] inline float SpeedAlong(const SoftBody& a, const SoftBody& b, const SoftContact::Point& p, float x,
                 float y) {
  const float vx = b.vx - b.w * p.by - a.vx + a.w * p.ay;
  const float vy = b.vy + b.w * p.bx - a.vy - a.w * p.ax;
  return vx * x + vy * y;
}

/// Returns the distance of the surfaces now, m.
[[gnu::always_inline]] inline float ApartNow(const SoftBody& a, const SoftBody& b, const SoftContact& contact,
               const SoftContact::Point& p) {
  const float x = b.dx - a.dx + (b.c * p.turn_bx - b.s * p.turn_by) -
                  (a.c * p.turn_ax - a.s * p.turn_ay);
  const float y = b.dy - a.dy + (b.s * p.turn_bx + b.c * p.turn_by) -
                  (a.s * p.turn_ax + a.c * p.turn_ay);
  return p.apart + x * contact.nx + y * contact.ny;
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
  contact->fixed = a.im <= 0 || b.im <= 0;
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

void SoftContacts::Kick(float h) {
  for (std::size_t i = 0; i < moving; ++i) {
    SoftBody& q = bodies[i];
    q.vx = (q.vx + h * q.ax) / (1 + h * q.slow);
    q.vy = (q.vy + h * q.ay) / (1 + h * q.slow);
    q.w = (q.w + h * q.turn) / (1 + h * q.slow_spin);
  }
}

/// Begins a substep with `share` of the last one's impulses.
void SoftContacts::WarmStart(float share) {
  for (SoftContact& contact : contacts) {
    SoftBody& a = bodies[static_cast<std::size_t>(contact.a)];
    SoftBody& b = bodies[static_cast<std::size_t>(contact.b)];
    for (int i = 0; i < contact.count; ++i) {
      SoftContact::Point& p = contact.point[i];
      p.pushed *= share;
      p.rubbed *= share;
      Apply(p, p.pushed * contact.nx + p.rubbed * contact.ny,
            p.pushed * contact.ny - p.rubbed * contact.nx, &a, &b);
    }
  }
}

/// Notes how fast points come that have not been pushed yet, for restitution.
void SoftContacts::Watch() {
  for (SoftContact& contact : contacts) {
    if (contact.restitution <= 0) continue;
    const SoftBody& a = bodies[static_cast<std::size_t>(contact.a)];
    const SoftBody& b = bodies[static_cast<std::size_t>(contact.b)];
    for (int i = 0; i < contact.count; ++i) {
      SoftContact::Point& p = contact.point[i];
      if (p.sum_n <= 0) p.closing = SpeedAlong(a, b, p, contact.nx, contact.ny);
    }
  }
}

/// Solves each contact once. With bias from the last to the first, so that both ends of a pile are
/// heard in a substep.
void SoftContacts::Push(float h, bool biased) {
  const float rate = 1 / h;
  for (std::size_t at = 0; at < contacts.size(); ++at) {
    SoftContact& contact = contacts[biased ? contacts.size() - 1 - at : at];
    SoftBody& a = bodies[static_cast<std::size_t>(contact.a)];
    SoftBody& b = bodies[static_cast<std::size_t>(contact.b)];
    const Softness& soft = contact.fixed ? stiff_ : soft_;
    for (int i = 0; i < contact.count; ++i) {
      SoftContact::Point& p = contact.point[i];
      const float apart = ApartNow(a, b, contact, p);
      float bias = 0, mass_scale = 1, impulse_scale = 0;
      if (apart > 0) {
        bias = apart * rate;
      } else if (biased) {
        bias = std::max(soft.bias_rate * apart, -kPushOutMost);
        mass_scale = soft.mass_scale;
        impulse_scale = soft.impulse_scale;
      }
      const float speed = SpeedAlong(a, b, p, contact.nx, contact.ny);
      const float to = std::max(0.0f, p.pushed - p.mass_n * mass_scale * (speed + bias) -
                                          impulse_scale * p.pushed);
      const float more = to - p.pushed;
      p.pushed = to;
      Apply(p, more * contact.nx, more * contact.ny, &a, &b);
    }
    for (int i = 0; i < contact.count; ++i) {
      SoftContact::Point& p = contact.point[i];
      const float apart = ApartNow(a, b, contact, p);
      float bias = 0, mass_scale = 1, impulse_scale = 0;
      if (apart > 0) {
        bias = apart * rate;
      } else if (biased) {
        bias = std::max(soft.bias_rate * apart, -kPushOutMost);
        mass_scale = soft.mass_scale;
        impulse_scale = soft.impulse_scale;
      }
      const float speed = SpeedAlong(a, b, p, contact.nx, contact.ny);
      const float to = std::max(0.0f, p.pushed - p.mass_n * mass_scale * (speed + bias) -
                                          impulse_scale * p.pushed);
      const float more = to - p.pushed;
      p.pushed = to;
      Apply(p, more * contact.nx, more * contact.ny, &a, &b);
    }
    for (int i = 0; i < contact.count; ++i) {
      SoftContact::Point& p = contact.point[i];
      const float most = contact.friction * p.pushed;
      const float speed = SpeedAlong(a, b, p, contact.ny, -contact.nx) - contact.belt;
      const float to = std::max(-most, std::min(p.rubbed - p.mass_t * speed, most));
      const float more = to - p.rubbed;
      p.rubbed = to;
      Apply(p, more * contact.ny, -more * contact.nx, &a, &b);
    }
  }
}

void SoftContacts::Drift(float h) {
  for (SoftBody& q : bodies) {
    q.dx += h * q.vx;
    q.dy += h * q.vy;
    const float turn = h * q.w;
    q.da += turn;
    const float c = q.c - turn * q.s, s = q.s + turn * q.c;
    const float length = std::sqrt(c * c + s * s);
    q.c = c / length;
    q.s = s / length;
  }
}

/// Gives points that were pushed their restitution, once.
void SoftContacts::Restore() {
  for (SoftContact& contact : contacts) {
    if (contact.restitution <= 0) continue;
    SoftBody& a = bodies[static_cast<std::size_t>(contact.a)];
    SoftBody& b = bodies[static_cast<std::size_t>(contact.b)];
    for (int i = 0; i < contact.count; ++i) {
      SoftContact::Point& p = contact.point[i];
      if (p.closing > -contact.threshold || p.sum_n <= 0) continue;
      const float speed = SpeedAlong(a, b, p, contact.nx, contact.ny);
      const float to =
          std::max(0.0f, p.pushed - p.mass_n * (speed + contact.restitution * p.closing));
      const float more = to - p.pushed;
      p.pushed = to;
      p.sum_n += more;
      Apply(p, more * contact.nx, more * contact.ny, &a, &b);
    }
  }
}

void SoftContacts::Step(float h, int substeps, int sweeps, bool warm) {
  const float hz = std::min(kContactHz, kRateShare / h);
  soft_ = SoftnessOf(hz, h);
  stiff_ = SoftnessOf(kFixedStiffer * hz, h);
  const auto halves = static_cast<float>(2 * substeps);
  const auto sum = [this] {
    for (SoftContact& contact : contacts) {
      for (int i = 0; i < contact.count; ++i) {
        contact.point[i].sum_n += contact.point[i].pushed;
        contact.point[i].sum_t += contact.point[i].rubbed;
      }
    }
  };
  for (int i = 0; i < substeps; ++i) {
    // Half a kick, then whole ones, and half of one at the end: velocities at the ends of a step
    // belong to the same moment as places, and the way under a steady force is exact.
    Kick(i == 0 ? h / 2 : h);
    Watch();
    WarmStart(i > 1 ? 1 : i == 1 ? 2 : warm ? 1 / halves : 0);
    for (int sweep = 0; sweep < sweeps; ++sweep) Push(h, true);
    Drift(h);
    Push(h, false);
    sum();
  }
  Kick(h / 2);
  WarmStart(0.5f);
  Push(h, false);
  sum();
  Restore();
  for (SoftContact& contact : contacts) {
    for (int i = 0; i < contact.count; ++i) {
      contact.point[i].pushed *= halves;
      contact.point[i].rubbed *= halves;
    }
  }
}

}  // namespace seam
