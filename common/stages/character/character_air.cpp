/// CharacterControl: jumping and landing.

#include <algorithm>
#include <cmath>

#include "common/stages/character/character_control.h"
#include "common/stages/character/character_gains.h"

namespace seam {

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
      // Through the centre of mass, plus a part that stops its rotation, which would be impossible
      // in the air.
      const b2Vec2 pressed = Sole(s, side, pressure);
      const float up = both ? 0.5f * lift : lift;
      const float stop = (both ? 0.5f : 1.0f) * gains_.jump_still * s.turning;
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
  const float depth = (sinks ? 0.88f : 0.78f) * (shape.thigh + shape.shank);
  const float omega = std::sqrt(gravity_ / shape.hip);
  const float ahead = sinks ? std::clamp(gains_.air_ahead * s.velocity.x / omega, -0.3f * shape.hip,
                                         0.4f * shape.hip)
                            : 0;
  const float apart = gains_.air_apart * shape.hip;
  for (int side = 0; side < 2; ++side) {
    const float x = s.hip.x + ahead + (side == memory_.stance ? apart : -apart);
    Reach(s, side, b2Vec2(x, s.hip.y - depth), s.hip_velocity, 0,
          sinks ? gains_.land_stiffness : gains_.air_stiffness);
  }
  Arms(0.8f, 0.8f, 0.4f);
}

}  // namespace seam
