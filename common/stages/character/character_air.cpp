/// CharacterControl: jumping and landing.

#include <algorithm>
#include <cmath>

#include "common/base/trig.h"
#include "common/stages/character/character_control.h"
#include "common/stages/character/character_gains.h"

namespace seam {
namespace {

/// Distance of the ankles below the hip at landing, share of straight legs.
constexpr float kLandDepth = 0.88f;

b2Vec2 Turned(b2Vec2 way, float angle) {
  const float sine = Sin(angle), cosine = Cos(angle);
  return b2Vec2(cosine * way.x - sine * way.y, sine * way.x + cosine * way.y);
}

}  // namespace

/// Crouches (only from standing), then pushes with every foot on the ground until both have left
/// it.
void CharacterControl::Jump(const CharacterSense& s) {
  const CharacterShape& shape = limbs_.shape();
  const LegSense& low = s.legs[s.legs[0].ankle.y < s.legs[1].ankle.y ? 0 : 1];
  const float ground_y = low.ankle.y - shape.ankle;
  const float height = (s.hip.y - ground_y) / shape.hip;
  if (memory_.phase == 0) {
    if (height < gains_.jump_crouch + 0.05f || memory_.time > gains_.jump_crouch_max)
      memory_.phase = 1;
  }
  const bool gone = memory_.phase >= 1 &&
                    ((!s.legs[0].down && !s.legs[1].down) || height > gains_.jump_stretched);
  if (gone || memory_.time > gains_.jump_max) {
    Enter(CharacterMode::kAir);
    Air(s);
    return;
  }
  const bool push = memory_.phase >= 1;
  const bool running = memory_.phase == 2;
  // Pressure behind the centre of mass accelerates forward.
  const float pressure = s.centre.x + (push ? 0 : s.velocity.x / Omega(s, ground_y)) -
                         (running ? 0 : gains_.jump_forward * limbs_.scale() * drive_);
  const float lift = push
                         ? gains_.jump_lift * s.mass * gravity_
                         : Lift(s, ground_y, gains_.jump_crouch * shape.hip, low.ground_velocity.y);
  const float torso = TorsoTorque(s, push ? 0 : -0.3f);
  const bool both = s.legs[0].down == s.legs[1].down;
  for (int side = 0; side < 2; ++side) {
    if (push && (both || s.legs[side].down)) {
      // Through the centre of mass, plus a part that gives the rotation that the flight needs: it
      // cannot change in the air. At the end, the foot stands on its toes: a force from beside them
      // would turn the body.
      const LegSense& leg = s.legs[side];
      const b2Vec2 pressed = leg.ankle + Turned(Sole(s, side, pressure) - leg.ankle, leg.foot);
      const float up = both ? 0.5f * lift : lift;
      const float stop = (both ? 0.5f : 1.0f) * gains_.jump_still * (s.turning - FlightTurning(s));
      Push(s, side, pressed, up,
           -((pressed.x - s.centre.x) * up + stop) / (s.centre.y - pressed.y));
    } else if (both || s.legs[side].down) {
      Bear(s, side, pressure, both ? 0.5f * lift : lift, both ? 0.5f * torso : torso);
    } else {
      Reach(s, side, s.hip + b2Vec2(0.1f * shape.hip, -0.6f * shape.hip), s.hip_velocity, 0,
            gains_.swing_stiffness);
    }
  }
  const float arms = push ? 1.5f : -0.8f;
  Arms(arms, arms, 0.2f);
}

/// Returns how far before the hip the feet land, m.
float CharacterControl::LandingAhead(const CharacterSense& s) const {
  const float hip = limbs_.shape().hip, omega = std::sqrt(gravity_ / hip);
  return std::clamp(gains_.air_ahead * s.velocity.x / omega, -0.3f * hip, 0.4f * hip);
}

/// Returns the angular momentum of a flight that ends with the torso upright and the legs ahead,
/// N m s. The hip is near the centre of mass, so legs and trunk turn about it.
float CharacterControl::FlightTurning(const CharacterSense& s) const {
  const CharacterShape& shape = limbs_.shape();
  const float landing = std::atan2(LandingAhead(s), kLandDepth * (shape.thigh + shape.shank));
  float turned = 0;  // inertia times angle
  for (int part = 0; part < kCharacterParts; ++part) {
    const b2Body* body = limbs_.body(static_cast<CharacterPart>(part));
    if (body == nullptr) continue;
    const b2Vec2 from_hip = limbs_.Own(body->GetWorldCenter()) - s.hip;
    const float inertia = body->GetInertia() + body->GetMass() * from_hip.LengthSquared();
    float angle = -s.torso;
    if (part >= kUpperLegLeft) {
      const b2Vec2 leg = s.legs[IsLeft(part) ? 0 : 1].ankle - s.hip;
      angle = landing - std::atan2(leg.x, -leg.y);
    }
    turned += inertia * angle;
  }
  return turned / (gains_.air_time * std::sqrt(limbs_.scale()));
}

/// Draws the legs up while rising; while sinking, stretches them to where the pendulum will need
/// them.
void CharacterControl::Air(const CharacterSense& s) {
  const CharacterShape& shape = limbs_.shape();
  const bool touch = s.legs[0].down || s.legs[1].down;
  if (touch && memory_.time > gains_.air_min) {
    const bool still = std::abs(s.velocity.x) < 0.5f;
    BeginStep(s, s.legs[0].down ? 0 : 1);
    memory_.speed = std::clamp(s.velocity.x, -gains_.speed_back, gains_.run_speed_max);
    Enter(still ? CharacterMode::kStand : CharacterMode::kStep);
    if (still)
      Stand(s);
    else
      StepOn(s, 0);
    return;
  }
  const bool sinks = s.velocity.y < 0.3f;
  const float depth = (sinks ? kLandDepth : 0.78f) * (shape.thigh + shape.shank);
  const float ahead = sinks ? LandingAhead(s) : 0;
  const float apart = gains_.air_apart * shape.hip;
  for (int side = 0; side < 2; ++side) {
    const float x = s.hip.x + ahead + (side == memory_.stance ? apart : -apart);
    Reach(s, side, b2Vec2(x, s.hip.y - depth), s.hip_velocity, 0,
          sinks ? gains_.land_stiffness : gains_.air_stiffness);
  }
  Arms(0.8f, 0.8f, 0.4f);
}

}  // namespace seam
