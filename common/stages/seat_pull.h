#pragma once
/// The bounded pull with which a seat draws a player in and puts a player out: all bodies move as
/// one rigid body, and their common centre changes its velocity by no more than kSeatPull.

#include "common/physics/stage.h"

namespace seam {

/// m/s^2, ten times gravity. More would drag a player along with any motion of the vehicle; with
/// less, a player who runs towards a moving vehicle would not reach it in time.
constexpr float kSeatPull = 100;

/// Sets the velocities that `velocity_of(body)` (of its centre, m/s) and `spin` (rad/s) demand
/// after a step of `h` s under `gravity`. If that exceeds kSeatPull, all velocities fall short by
/// the same amount. `each` calls its argument for every body, with the body's mass, kg. Returns the
/// momentum transferred, N s.
template <typename Each, typename VelocityOf>
b2Vec2 PullTogether(const Each& each, const VelocityOf& velocity_of, float spin, float h,
                    const b2Vec2& gravity) {
  float whole = 0;
  b2Vec2 before(0, 0), asked(0, 0), fall(0, 0);
  each([&](b2Body* body, float mass) {
    whole += mass;
    before += mass * body->GetLinearVelocity();
    asked += mass * velocity_of(body);
    fall += mass * h * body->GetGravityScale() * gravity;
  });
  if (whole <= 0) return b2Vec2(0, 0);
  const b2Vec2 change = (1 / whole) * (asked - before);
  const float most = kSeatPull * h, size = change.Length();
  const b2Vec2 short_by = size > most ? (1 - most / size) * change : b2Vec2(0, 0);
  each([&](b2Body* body, float /*mass*/) {
    body->SetLinearVelocity(velocity_of(body) - short_by - h * body->GetGravityScale() * gravity);
    body->SetAngularVelocity(spin);
  });
  return asked - before - whole * short_by - fall;
}

}  // namespace seam
