#include "common/physics/rest/slow_watch.h"

#include <algorithm>
#include <cmath>

#include "common/physics/reveal.h"

namespace seam {
namespace {

SEAM_REVEAL(QuietTime, float, b2Body, m_sleepTime);

/// Time after which a body that goes on in every step is not quiet, s. Speeds of piles rise and
/// fall from step to step, so that none rises for so long.
constexpr float kGoingFor = b2_timeToSleep / 2;

/// Time within which an acceleration alone may not move a body by the engine's slop, s. Longer ones
/// let damped bodies sleep later; with shorter ones slow swings end beside their rest.
constexpr float kTurnsIn = 4;
/// A body that slows down and stops sooner than this, s, may come to rest: the time does not count.
/// Together with kGoingFor less than b2_timeToSleep, so that nothing sleeps while it turns.
constexpr float kStopsIn = b2_timeToSleep / 4;

/// Change of speed in a second, as a multiple of the engine's tolerances, up to which the speed is
/// steady: 2e-5 m/s. Rounding in the solver makes up to a tenth of it; longer ones would join the
/// rises and falls of what trembles.
constexpr float kSteadyIn = 2e-3f;

/// Returns the body's speed and spin as a multiple of the engine's tolerances.
float SpeedOf(const b2Body& body) {
  const float spin = body.GetAngularVelocity() / b2_angularSleepTolerance;
  return std::sqrt(body.GetLinearVelocity().LengthSquared() /
                       (b2_linearSleepTolerance * b2_linearSleepTolerance) +
                   spin * spin);
}

/// True if the contact carries load, and its surfaces are no belt that moves.
bool IsPressed(b2Contact& contact) {
  if (!contact.IsTouching() || contact.GetTangentSpeed() != 0) return false;
  const b2Manifold& manifold = *contact.GetManifold();
  for (int32 i = 0; i < manifold.pointCount; ++i) {
    if (manifold.points[i].normalImpulse > 0) return true;
  }
  return false;
}

/// True if a joint, a pressed contact, or water acts on the body.
bool IsHeld(b2Body* body) {
  if (body->GetJointList() != nullptr) return true;
  for (b2ContactEdge* edge = body->GetContactList(); edge != nullptr; edge = edge->next) {
    b2Contact& contact = *edge->contact;
    const bool sensor = contact.GetFixtureA()->IsSensor() || contact.GetFixtureB()->IsSensor();
    if (sensor ? contact.IsTouching() : IsPressed(contact)) return true;
  }
  return false;
}

}  // namespace

void SlowWatch::Reset(std::size_t bodies) {
  going_s_.assign(bodies, 0);
  before_.assign(bodies, Motion());
  found_.assign(bodies, 0);
}

void SlowWatch::Before(const std::vector<int>& present, const BuiltScene& built) {
  for (const int body : present) {
    const auto i = static_cast<std::size_t>(body);
    const b2Body& b = *built.moving[i].body;
    if (b.IsAwake()) before_[i] = {SpeedOf(b), b.GetLinearVelocity(), b.GetAngularVelocity()};
  }
}

void SlowWatch::After(const std::vector<int>& present, const std::vector<Activity>& activities,
                      const BuiltScene& built, float h) {
  ++steps_;
  for (const int body : present) {
    const auto i = static_cast<std::size_t>(body);
    b2Body* b = built.moving[i].body;
    float& quiet = b->*Member(QuietTime());
    const bool goes = b->IsAwake() && quiet > 0 && activities[i] == Activity::kSimulated &&
                      GoesOn(b, before_[i].speed, h);
    const float after = SpeedOf(*b), lost = before_[i].speed - after;
    const bool same_way = b2Dot(b->GetLinearVelocity(), before_[i].velocity) /
                                  (b2_linearSleepTolerance * b2_linearSleepTolerance) +
                              b->GetAngularVelocity() * before_[i].spin /
                                  (b2_angularSleepTolerance * b2_angularSleepTolerance) >=
                          0;
    float& going = going_s_[i];
    if (!goes) {
      going = 0;
    } else if (same_way && std::fabs(lost) <= kSteadyIn * h) {
      going += going < 0 ? -h : h;
    } else if (lost < 0) {
      going = std::fabs(going) + h;
    } else {
      going = std::min(going, 0.f) - (after * h > lost * kStopsIn ? h : 0);
    }
    if (std::fabs(going) >= kGoingFor) quiet = 0;
  }
}

bool SlowWatch::GoesOn(b2Body* body, float before, float h) {
  const float after = SpeedOf(*body);
  // Such a step is lost in single precision at a metre from the origin.
  if (after * h < b2_epsilon / b2_linearSleepTolerance) return false;
  if (after > before || !IsHeld(body)) return true;
  const float lost = before - after;
  const bool comes_to_rest = lost * b2_timeToSleep >= before * after * h;
  const bool turns = lost * kTurnsIn * kTurnsIn > 2 * b2_timeToSleep * h;
  return (turns || !comes_to_rest) && !Rests(body);
}

/// Follows pressed contacts until one is with something that is not dynamic.
bool SlowWatch::Rests(b2Body* body) {
  chain_.assign(1, body);
  bool rests = false;
  for (std::size_t next = 0; next < chain_.size() && !rests; ++next) {
    std::int64_t& found = found_[static_cast<std::size_t>(IndexOf(chain_[next]))];
    rests = found == steps_;
    if (found == steps_ || found == -steps_) continue;
    found = -steps_;
    for (b2ContactEdge* edge = chain_[next]->GetContactList(); edge != nullptr && !rests;
         edge = edge->next) {
      if (!IsPressed(*edge->contact)) continue;
      rests = edge->other->GetType() != b2_dynamicBody;
      chain_.push_back(edge->other);
    }
  }
  if (!rests) return false;
  for (b2Body* one : chain_) {
    if (one->GetType() == b2_dynamicBody) found_[static_cast<std::size_t>(IndexOf(one))] = steps_;
  }
  return true;
}

}  // namespace seam
