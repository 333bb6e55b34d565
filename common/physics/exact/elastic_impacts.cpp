#include "common/physics/exact/elastic_impacts.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "common/physics/engine_members.h"
#include "common/physics/exact/shared_rules.h"

namespace seam {
namespace {

/// Restitution from here on counts as 1.
constexpr float kEverything = 0.999f;
/// Speed above which a body has an impact even without gravity, m/s; added to the fall of
/// kRestSteps.
constexpr double kSlowestElastic = 1e-3;
/// Impacts per contact in one step; and limit of contact checks in a step, which must end even
/// where thousands of bodies start in one place.
constexpr std::size_t kElasticImpactsEach = 8, kLooksMost = 5000000;
/// Iterations over the points and directions of a contact, until no impulse changes by more than
/// this share.
constexpr int kSweepsMax = 300;
constexpr double kSettledShare = 1e-12;
/// A gain of energy up to this share counts as rounding.
constexpr double kRounded = 1e-7;
constexpr double kFast = 1e9;  // m/s, faster than anything

/// Returns the acceleration by gravity and forces, m/s2.
b2Vec2 Pull(const b2World& world, b2Body* body) {
  if (!Moves(body)) return {0, 0};
  return body->GetGravityScale() * world.GetGravity() +
         body->*Member(BodyInverseMass()) * (body->*Member(BodyForce()));
}

bool HasElastic(const b2Body* body) {
  for (const b2Fixture* f = body->GetFixtureList(); f != nullptr; f = f->GetNext()) {
    if (f->GetRestitution() >= kEverything) return true;
  }
  return false;
}

}  // namespace

bool HasElastic(const Scene& scene) {
  return std::any_of(scene.parts.begin(), scene.parts.end(), [](const Part& part) {
    return !part.gone && part.material.restitution >= kEverything;
  });
}

ElasticImpacts::ElasticImpacts(const BuiltScene& built, std::vector<char> jointed)
    : jointed_(std::move(jointed)), place_(jointed_.size(), -1) {
  bool free = false;
  for (const char held : jointed_) free = free || held == 0;
  // Anchored assemblies share bodies: visit each once.
  const std::set<const b2Body*> all(built.bodies.begin(), built.bodies.end());
  for (const b2Body* body : all) needed_ = needed_ || (free && HasElastic(body));
  for (const MovingBody& m : built.moving) needed_ = needed_ || (free && HasElastic(m.body));
}

bool ElasticImpacts::Free(b2Body* body) const {
  return !Moves(body) || jointed_[static_cast<std::size_t>(IndexOf(body))] == 0;
}

/// Returns the body's index in bodies_, to which it is added if necessary. Immovable bodies have
/// one for each contact.
int ElasticImpacts::Place(const b2World& world, float behind_s, b2Body* body) {
  const bool moves = Moves(body);
  if (moves) {
    int& known = place_[static_cast<std::size_t>(IndexOf(body))];
    if (known >= 0) return known;
    known = static_cast<int>(bodies_.size());
  }
  Body q;
  q.body = body;
  q.im = moves ? static_cast<double>(body->*Member(BodyInverseMass())) : 0;
  q.ii = moves ? static_cast<double>(body->*Member(BodyInverseInertia())) : 0;
  const b2Vec2 pull = Pull(world, body);
  q.kick_x = static_cast<double>(behind_s) * static_cast<double>(pull.x);
  q.kick_y = static_cast<double>(behind_s) * static_cast<double>(pull.y);
  q.vx = static_cast<double>(body->GetLinearVelocity().x) + q.kick_x;
  q.vy = static_cast<double>(body->GetLinearVelocity().y) + q.kick_y;
  q.w = static_cast<double>(body->GetAngularVelocity());
  bodies_.push_back(q);
  return static_cast<int>(bodies_.size()) - 1;
}

void ElasticImpacts::Find(b2World* world, float h, float behind_s) {
  for (b2Contact* c = world->GetContactList(); c != nullptr; c = c->GetNext()) {
    if (c->GetRestitution() < kEverything) continue;
    b2Fixture* const fixture_a = c->GetFixtureA();
    b2Fixture* const fixture_b = c->GetFixtureB();
    b2Body* const a = fixture_a->GetBody();
    b2Body* const b = fixture_b->GetBody();
    if (!Free(a) || !Free(b)) continue;
    const float pull = std::max(Pull(*world, a).Length(), Pull(*world, b).Length());
    const double rest = kSlowestElastic + kRestSteps * static_cast<double>(h * pull);
    const float usual =
        std::min(fixture_a->GetRestitutionThreshold(), fixture_b->GetRestitutionThreshold());
    // For impacts of continuous collision, too.
    c->SetRestitutionThreshold(std::min(usual, static_cast<float>(rest)));
    if (!Pushes(c) || !(a->IsAwake() || b->IsAwake())) continue;
    b2WorldManifold manifold;
    c->GetWorldManifold(&manifold);
    Touch touch;
    touch.made = c;
    touch.a = Place(*world, behind_s, a);
    touch.b = Place(*world, behind_s, b);
    touch.nx = static_cast<double>(manifold.normal.x);
    touch.ny = static_cast<double>(manifold.normal.y);
    touch.threshold = static_cast<double>(c->GetRestitutionThreshold());
    touch.points = c->GetManifold()->pointCount;
    for (int i = 0; i < touch.points; ++i) {
      const b2Vec2 at_a = manifold.points[i] - a->GetWorldCenter();
      const b2Vec2 at_b = manifold.points[i] - b->GetWorldCenter();
      Point& point = touch.point[i];
      point.ax = static_cast<double>(at_a.x);
      point.ay = static_cast<double>(at_a.y);
      point.bx = static_cast<double>(at_b.x);
      point.by = static_cast<double>(at_b.y);
    }
    Look(&touch);
    touches_.push_back(touch);
  }
}

void ElasticImpacts::Speeds(const Touch& touch, const Point& p, double* normal, double* tangent) {
  const Body& a = At(touch.a);
  const Body& b = At(touch.b);
  const double x = b.vx - b.w * p.by - a.vx + a.w * p.ay;
  const double y = b.vy + b.w * p.bx - a.vy - a.w * p.ax;
  *normal = x * touch.nx + y * touch.ny;
  *tangent = x * touch.ny - y * touch.nx;
}

void ElasticImpacts::Look(Touch* touch) {
  touch->closing = -kFast;
  for (int i = 0; i < touch->points; ++i) {
    double normal = 0, tangent = 0;
    Speeds(*touch, touch->point[i], &normal, &tangent);
    touch->closing = std::max(touch->closing, -normal);
  }
}

void ElasticImpacts::Push(const Touch& touch, const Point& p, double normal, double tangent) {
  const double x = normal * touch.nx + tangent * touch.ny;
  const double y = normal * touch.ny - tangent * touch.nx;
  Body& a = At(touch.a);
  Body& b = At(touch.b);
  a.vx -= a.im * x;
  a.vy -= a.im * y;
  a.w -= a.ii * (p.ax * y - p.ay * x);
  b.vx += b.im * x;
  b.vy += b.im * y;
  b.w += b.ii * (p.bx * y - p.by * x);
}

/// Solves an impact with `share` of its restitution: each point separates at no less than that
/// times its approach speed, and friction is at most its share of the normal impulse. Returns the
/// kinetic energy gained, J.
double ElasticImpacts::Solve(const Touch& touch, double share, double* pushed, double* rubbed) {
  const Body& a = At(touch.a);
  const Body& b = At(touch.b);
  const auto energy = [](const Body& q) {
    const double moving = q.im > 0 ? (q.vx * q.vx + q.vy * q.vy) / q.im : 0;
    return (moving + (q.ii > 0 ? q.w * q.w / q.ii : 0)) / 2;
  };
  const double before = energy(a) + energy(b);
  const auto friction = static_cast<double>(touch.made->GetFriction());
  const auto belt = static_cast<double>(touch.made->GetTangentSpeed());
  const double back = share * static_cast<double>(touch.made->GetRestitution());
  double target[b2_maxManifoldPoints] = {};
  double normal = 0, tangent = 0;
  for (int i = 0; i < touch.points; ++i) {
    Speeds(touch, touch.point[i], &normal, &tangent);
    target[i] = -back * normal;
    pushed[i] = rubbed[i] = 0;
  }
  for (int round = 0; round < kSweepsMax; ++round) {
    double most = 0, change = 0;
    for (int i = 0; i < touch.points; ++i) {
      const Point& p = touch.point[i];
      const auto answer = [&](double x, double y) {
        const double aw = p.ax * y - p.ay * x, bw = p.bx * y - p.by * x;
        return a.im + b.im + a.ii * aw * aw + b.ii * bw * bw;
      };
      Speeds(touch, p, &normal, &tangent);
      const double to =
          std::max(0.0, pushed[i] + (target[i] - normal) / answer(touch.nx, touch.ny));
      Push(touch, p, to - pushed[i], 0);
      change = std::max(change, std::fabs(to - pushed[i]));
      pushed[i] = to;
      most = std::max(most, to);
      if (friction <= 0) continue;
      Speeds(touch, p, &normal, &tangent);
      const double rub = std::clamp(rubbed[i] + (belt - tangent) / answer(touch.ny, -touch.nx),
                                    -friction * to, friction * to);
      Push(touch, p, 0, rub - rubbed[i]);
      change = std::max(change, std::fabs(rub - rubbed[i]));
      rubbed[i] = rub;
    }
    if (change <= kSettledShare * most) break;
  }
  const double gained = energy(a) + energy(b) - before;
  return friction > 0 && gained > kRounded * before ? gained : 0;
}

/// Solves an impact. With friction it may gain energy (Kane and Levinson 1985): then restitution is
/// reduced, unless a belt or a moving platform supplies the energy.
void ElasticImpacts::Blow(Touch* touch) {
  bool driven = touch->made->GetTangentSpeed() != 0;
  for (const int end : {touch->a, touch->b}) {
    const Body& q = At(end);
    driven = driven || (q.im <= 0 && (q.vx != 0 || q.vy != 0 || q.w != 0));
  }
  const Body a = At(touch->a), b = At(touch->b);
  double pushed[b2_maxManifoldPoints] = {}, rubbed[b2_maxManifoldPoints] = {};
  double share = 1;
  for (int tries = 0;; ++tries) {
    const double gained = Solve(*touch, share, pushed, rubbed);
    if (driven || gained <= 0 || tries == kSofterTries) break;
    share = tries + 1 == kSofterTries ? 0 : share / 2;
    At(touch->a) = a;
    At(touch->b) = b;
  }
  At(touch->a).struck = At(touch->b).struck = true;
  for (int i = 0; i < touch->points; ++i) {
    touch->point[i].pushed += pushed[i];
    touch->point[i].rubbed += rubbed[i];
  }
}

void ElasticImpacts::Tell(b2World* world) {
  for (const Body& q : bodies_) {
    if (!q.struck || q.im <= 0) continue;
    q.body->SetLinearVelocity(
        {static_cast<float>(q.vx - q.kick_x), static_cast<float>(q.vy - q.kick_y)});
    q.body->SetAngularVelocity(static_cast<float>(q.w));
  }
  b2ContactListener* const listener = world->GetContactManager().m_contactListener;
  if (listener == nullptr) return;
  for (const Touch& touch : touches_) {
    b2ContactImpulse impulse;
    impulse.count = touch.points;
    double sum = 0;
    for (int i = 0; i < touch.points; ++i) {
      impulse.normalImpulses[i] = static_cast<float>(touch.point[i].pushed);
      impulse.tangentImpulses[i] = static_cast<float>(touch.point[i].rubbed);
      sum += touch.point[i].pushed;
    }
    if (sum > 0) listener->PostSolve(touch.made, &impulse);
  }
}

void ElasticImpacts::Done() {
  for (const Touch& touch : touches_) {
    if (touch.parts) touch.made->SetEnabled(true);
  }
}

void ElasticImpacts::Act(b2World* world, float h, float behind_s) {
  bodies_.clear();
  touches_.clear();
  Find(world, h, behind_s);
  const std::size_t touches = std::max<std::size_t>(touches_.size(), 1);
  const std::size_t most = std::min(kElasticImpactsEach * touches, kLooksMost / touches);
  for (std::size_t blow = 0; blow < most; ++blow) {
    Touch* fastest = nullptr;
    for (Touch& touch : touches_) {
      const bool hits = touch.closing > touch.threshold;
      if (hits && (fastest == nullptr || touch.closing > fastest->closing)) fastest = &touch;
    }
    if (fastest == nullptr) break;
    Blow(fastest);
    const auto shares = [&](int body) {
      return At(body).im > 0 && (body == fastest->a || body == fastest->b);
    };
    for (Touch& touch : touches_) {
      if (shares(touch.a) || shares(touch.b)) Look(&touch);
    }
  }
  for (Touch& touch : touches_) {
    touch.parts = touch.closing < -touch.threshold;
    if (touch.parts) touch.made->SetEnabled(false);
  }
  Tell(world);
  for (const Body& q : bodies_) {
    if (q.im > 0) place_[static_cast<std::size_t>(IndexOf(q.body))] = -1;
  }
}

}  // namespace seam
