#pragma once
/// The bounded pull by which a seat draws somebody in and sets somebody down: all bodies move as
/// one rigid thing, and their common centre changes its velocity by no more than kSeatPull.

#include "common/physics/stage.h"

namespace seam {

/// m/s^2, ten times the weight. More would tear who is drawn along with whatever the vehicle does;
/// with less, who runs towards a vehicle that drives does not get there in time.
constexpr float kSeatPull = 100;

/// Sets the velocities that `velocity_of(body)`, m/s of its centre, and `spin`, rad/s, ask for
/// after a step of `h` s under `gravity`, all of them short by the same where that is beyond
/// kSeatPull. `each` calls what it is given for every body, with its mass, kg. Returns the momentum
/// that it took, N s.
template <typename Each, typename VelocityOf>
b2Vec2 PullTogether(const Each& each, const VelocityOf& velocity_of, float spin, float h,
                    const b2Vec2& gravity) {
  float whole = 0;
  b2Vec2 before(0, 0), asked(0, 0);
  each([&](b2Body* body, float mass) {
    whole += mass;
    before += mass * body->GetLinearVelocity();
    asked += mass * velocity_of(body);
  });
  if (whole <= 0) return b2Vec2(0, 0);
  const b2Vec2 change = (1 / whole) * (asked - before);
  const float most = kSeatPull * h, size = change.Length();
  const b2Vec2 short_by = size > most ? (1 - most / size) * change : b2Vec2(0, 0);
  each([&](b2Body* body, float /*mass*/) {
    body->SetLinearVelocity(velocity_of(body) - short_by - h * gravity);
    body->SetAngularVelocity(spin);
  });
  return asked - before - whole * (short_by + h * gravity);
}

}  // namespace seam
