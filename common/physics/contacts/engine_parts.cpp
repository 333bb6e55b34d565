#include "common/physics/contacts/engine_parts.h"

#include <cmath>

#include "common/physics/engine_members.h"

namespace seam {
namespace {

/// Gives the engine only pairs of boxes that have no contact yet.
struct Unknown {
  b2ContactManager& manager;

  static bool Has(b2Body* at, const b2FixtureProxy& a, const b2FixtureProxy& b) {
    for (const b2ContactEdge* edge = at->GetContactList(); edge != nullptr; edge = edge->next) {
      b2Contact* const c = edge->contact;
      const b2Fixture *const f = c->GetFixtureA(), *const g = c->GetFixtureB();
      const int i = c->GetChildIndexA(), j = c->GetChildIndexB();
      if (f == a.fixture && g == b.fixture && i == a.childIndex && j == b.childIndex) return true;
      if (f == b.fixture && g == a.fixture && i == b.childIndex && j == a.childIndex) return true;
    }
    return false;
  }
  void AddPair(void* first, void* second) {
    const auto& a = *static_cast<b2FixtureProxy*>(first);
    const auto& b = *static_cast<b2FixtureProxy*>(second);
    b2Body* const body_a = a.fixture->GetBody();
    b2Body* const body_b = b.fixture->GetBody();
    if (!Moves(body_a) && !Moves(body_b)) return;
    if (Has(Moves(body_a) ? body_a : body_b, a, b)) return;
    manager.AddPair(first, second);
  }
};

}  // namespace

void FindNewPairs(b2World* world) {
  auto& manager = const_cast<b2ContactManager&>(world->GetContactManager());
  Unknown unknown{manager};
  manager.m_broadPhase.UpdatePairs(&unknown);
}

void MoveKinematic(b2World* world, b2Body* body, float h) {
  if (!body->IsAwake() || !body->IsEnabled()) return;
  b2Sweep& sweep = body->*Member(BodySweep());
  sweep.c0 = sweep.c;
  sweep.a0 = sweep.a;
  b2Vec2& v = body->*Member(BodyVelocity());
  float& w = body->*Member(BodySpin());
  const float way = (h * v).LengthSquared(), turn = std::fabs(h * w);
  if (way > b2_maxTranslationSquared) v *= b2_maxTranslation / std::sqrt(way);
  if (turn > b2_maxRotation) w *= b2_maxRotation / turn;
  sweep.c += h * v;
  sweep.a += h * w;
  b2Transform& pose = body->*Member(BodyPose());
  pose.q.Set(sweep.a);
  pose.p = sweep.c - b2Mul(pose.q, sweep.localCenter);
  (body->*Member(SyncFixtures()))();
  if (!world->GetAllowSleeping()) return;
  const bool slow = w * w <= b2_angularSleepTolerance * b2_angularSleepTolerance &&
                    v.LengthSquared() <= b2_linearSleepTolerance * b2_linearSleepTolerance;
  float& slept = body->*Member(BodySleepTime());
  slept = slow && (body->*Member(BodyFlags()) & kBodyAutoSleep) != 0 ? slept + h : 0;
  if (slept >= b2_timeToSleep) body->SetAwake(false);
}

}  // namespace seam
