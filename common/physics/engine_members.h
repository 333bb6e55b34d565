#pragma once
/// Private members of the engine that an exact step needs: a body's motion, and the parts of
/// b2World::Step.

#include <box2d/box2d.h>

#include "common/physics/reveal.h"

namespace seam {
namespace {

SEAM_REVEAL(BodyFlags, uint16, b2Body, m_flags);
SEAM_REVEAL(BodyPose, b2Transform, b2Body, m_xf);
SEAM_REVEAL(BodySweep, b2Sweep, b2Body, m_sweep);
SEAM_REVEAL(BodyVelocity, b2Vec2, b2Body, m_linearVelocity);
SEAM_REVEAL(BodySpin, float, b2Body, m_angularVelocity);
SEAM_REVEAL(BodyForce, b2Vec2, b2Body, m_force);
SEAM_REVEAL(BodyTorque, float, b2Body, m_torque);
SEAM_REVEAL(BodyInverseMass, float, b2Body, m_invMass);
SEAM_REVEAL(BodyInverseInertia, float, b2Body, m_invI);
SEAM_REVEAL(BodyInertia, float, b2Body, m_I);
SEAM_REVEAL(BodySleepTime, float, b2Body, m_sleepTime);
SEAM_REVEAL(ContactFlags, uint32, b2Contact, m_flags);
SEAM_REVEAL(NewContacts, bool, b2World, m_newContacts);
SEAM_REVEAL(Locked, bool, b2World, m_locked);
SEAM_REVEAL(LastInverseStep, float, b2World, m_inv_dt0);
SEAM_REVEAL(StepComplete, bool, b2World, m_stepComplete);

struct SyncFixtures {
  using Type = void (b2Body::*)();
  friend Type Member(SyncFixtures);
};
template struct Reveal<SyncFixtures, &b2Body::SynchronizeFixtures>;
struct EngineSolve {
  using Type = void (b2World::*)(const b2TimeStep&);
  friend Type Member(EngineSolve);
};
template struct Reveal<EngineSolve, &b2World::Solve>;
struct EngineSolveToi {
  using Type = void (b2World::*)(const b2TimeStep&);
  friend Type Member(EngineSolveToi);
};
template struct Reveal<EngineSolveToi, &b2World::SolveTOI>;

// The engine's own bits, which have no public names (b2_body.h, b2_contact.h).
constexpr uint16 kBodyAwake = 0x0002, kBodyAutoSleep = 0x0004, kBodyEnabled = 0x0020;
constexpr uint32 kContactEnabled = 0x0004;

/// True if the contact acts on its bodies.
inline bool Pushes(const b2Contact* contact) {
  return contact->IsTouching() && contact->IsEnabled() && !contact->GetFixtureA()->IsSensor() &&
         !contact->GetFixtureB()->IsSensor();
}

inline bool Moves(const b2Body* body) { return body->GetType() == b2_dynamicBody; }

}  // namespace
}  // namespace seam
