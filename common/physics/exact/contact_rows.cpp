#include "common/physics/exact/contact_rows.h"

#include <algorithm>

namespace seam {
namespace {

/// Share of an overlap that is undone per step, and the maximal speed of that, m/s: the engine's
/// own.
constexpr double kPushOut = 0.2;
constexpr double kPushOutMost = 2;
/// m/s: slower impacts have no restitution even without gravity.
constexpr double kSlowestSliding = 1e-6;

void Split(const b2Fixture* fixture, const ExactBody& body, double px, double py, double* turning_x,
           double* turning_y, double* still_x, double* still_y) {
  double gx = px - body.x, gy = py - body.y;
  *still_x = *still_y = 0;
  if (fixture->GetType() == b2Shape::e_circle) {
    const auto& circle = *static_cast<const b2CircleShape*>(fixture->GetShape());
    const b2Vec2 centre = b2Mul(body.body->GetTransform(), circle.m_p);
    gx = static_cast<double>(centre.x) - body.x;
    gy = static_cast<double>(centre.y) - body.y;
    *still_x = px - static_cast<double>(centre.x);
    *still_y = py - static_cast<double>(centre.y);
  }
  *turning_x = body.c * gx + body.s * gy;
  *turning_y = -body.s * gx + body.c * gy;
}

struct Arms {
  double ax, ay, bx, by;
};

Arms ArmsOf(const ExactContact::Point& p, const ExactBody& a, const ExactBody& b) {
  return {a.c * p.ax - a.s * p.ay + p.still_ax, a.s * p.ax + a.c * p.ay + p.still_ay,
          b.c * p.bx - b.s * p.by + p.still_bx, b.s * p.bx + b.c * p.by + p.still_by};
}

double Way(const Arms& r, const ExactBody& a, const ExactBody& b, double nx, double ny) {
  return nx * (b.x + r.bx - a.x - r.ax) + ny * (b.y + r.by - a.y - r.ay);
}

void Bind(const ExactContact& contact, const ExactBody& a, const ExactBody& b, const Arms& r,
          double ux, double uy, Row* row) {
  row->ends = 0;
  row->fixed_speed = 0;
  row->tense_a = row->tense_b = -1;
  row->gamma = 0;
  const double aw = -(r.ax * uy - r.ay * ux), bw = r.bx * uy - r.by * ux;
  if (a.moves()) {
    row->End(contact.a, -ux, -uy, aw);
  } else {
    row->fixed_speed += -ux * a.vx - uy * a.vy + aw * a.w;
  }
  if (b.moves()) {
    row->End(contact.b, ux, uy, bw);
  } else {
    row->fixed_speed += ux * b.vx + uy * b.vy + bw * b.w;
  }
}

}  // namespace

void ReadContact(const std::vector<ExactBody>& bodies, double rest, ExactContact* contact) {
  b2Contact* made = contact->made;
  b2WorldManifold world;
  made->GetWorldManifold(&world);
  contact->count = made->GetManifold()->pointCount;
  contact->nx = static_cast<double>(world.normal.x);
  contact->ny = static_cast<double>(world.normal.y);
  contact->friction = static_cast<double>(made->GetFriction());
  contact->restitution = static_cast<double>(made->GetRestitution());
  contact->threshold =
      std::min(static_cast<double>(made->GetRestitutionThreshold()), rest + kSlowestSliding);
  contact->returns = contact->restitution >= 1 && rest == 0;
  contact->belt = static_cast<double>(made->GetTangentSpeed());
  const ExactBody& a = bodies[static_cast<std::size_t>(contact->a)];
  const ExactBody& b = bodies[static_cast<std::size_t>(contact->b)];
  for (int i = 0; i < contact->count; ++i) {
    ExactContact::Point& p = contact->point[i];
    const auto px = static_cast<double>(world.points[i].x);
    const auto py = static_cast<double>(world.points[i].y);
    Split(made->GetFixtureA(), a, px, py, &p.ax, &p.ay, &p.still_ax, &p.still_ay);
    Split(made->GetFixtureB(), b, px, py, &p.bx, &p.by, &p.still_bx, &p.still_by);
    p.apart = static_cast<double>(world.separations[i]) -
              Way(ArmsOf(p, a, b), a, b, contact->nx, contact->ny);
  }
}

double NormalTarget(double separation, const Pace& pace) {
  if (separation > 0) return -separation / pace.h;
  const double deep = std::max(0.0, -separation - static_cast<double>(b2_linearSlop));
  return std::min(kPushOutMost, kPushOut / (pace.h * pace.substeps) * deep);
}

void FillContact(const ExactContact& contact, const std::vector<ExactBody>& bodies,
                 const Pace& pace, Row* rows) {
  const ExactBody& a = bodies[static_cast<std::size_t>(contact.a)];
  const ExactBody& b = bodies[static_cast<std::size_t>(contact.b)];
  for (int i = 0; i < contact.count; ++i) {
    const Arms r = ArmsOf(contact.point[i], a, b);
    Row& normal = rows[2 * i];
    Row& friction = rows[2 * i + 1];
    Bind(contact, a, b, r, contact.nx, contact.ny, &normal);
    normal.kind = RowKind::kNormal;
    normal.error = contact.point[i].apart + Way(r, a, b, contact.nx, contact.ny);
    normal.lo = 0;
    normal.hi = kUnbounded;
    normal.target = NormalTarget(normal.error, pace);
    Bind(contact, a, b, r, contact.ny, -contact.nx, &friction);
    friction.kind = RowKind::kFriction;
    friction.friction = contact.friction;
    friction.target = contact.belt;
    friction.error = 0;
  }
}

void LoadImpulses(const ExactContact& contact, double share, Row* rows) {
  const b2Manifold& manifold = *contact.made->GetManifold();
  for (int i = 0; i < contact.count; ++i) {
    const double pushed = share * static_cast<double>(manifold.points[i].normalImpulse);
    const double rubbed = share * static_cast<double>(manifold.points[i].tangentImpulse);
    Row& normal = rows[2 * i];
    Row& friction = rows[2 * i + 1];
    normal.base = normal.warm = pushed;
    friction.base = friction.warm = rubbed;
    friction.most = contact.friction * pushed;
    normal.state = pushed > 0 ? RowState::kFree : RowState::kLow;
    friction.state = pushed <= 0                                      ? RowState::kLow
                     : std::fabs(rubbed) < friction.most * (1 - 1e-6) ? RowState::kFree
                     : rubbed < 0                                     ? RowState::kLow
                                                                      : RowState::kHigh;
  }
}

void StoreImpulses(const ExactContact& contact, const Row* rows) {
  b2Manifold& manifold = *contact.made->GetManifold();
  for (int i = 0; i < contact.count; ++i) {
    manifold.points[i].normalImpulse = static_cast<float>(std::max(0.0, rows[2 * i].total));
    manifold.points[i].tangentImpulse = static_cast<float>(rows[2 * i + 1].total);
  }
}

}  // namespace seam
