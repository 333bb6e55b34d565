/// CharacterControl: support by the legs, and standing.

#include <algorithm>
#include <cmath>

#include "common/base/trig.h"
#include "common/stages/character/character_control.h"
#include "common/stages/character/character_gains.h"

namespace seam {
float CharacterControl::TorsoTorque(const CharacterSense& s, float lean) const {
  return unit_ * (gains_.torso_stiffness * (lean - s.torso) - gains_.torso_damping * s.torso_spin);
}

float CharacterControl::Lift(const CharacterSense& s, float ground_y, float hip_height,
                             float ground_vy, float stiffness, float damping) const {
  const float error = ground_y + hip_height - s.hip.y;
  const float proposed = s.mass * (gravity_ + stiffness * error / limbs_.scale() -
                                   damping * (s.hip_velocity.y - ground_vy));
  return std::clamp(proposed, gains_.lift_min * s.mass * gravity_,
                    gains_.lift_max * s.mass * gravity_);
}

/// Pushes the ground through one leg with `lift` N at `pressure_x`, and the torso with
/// `torso_torque`. The force's horizontal part follows from the two.
void CharacterControl::Bear(const CharacterSense& s, int side, float pressure_x, float lift,
                            float torso_torque) {
  const b2Vec2 pressure = Sole(s, side, pressure_x);
  const float height = std::max(0.2f * limbs_.shape().hip, s.hip.y - pressure.y);
  // The push goes through the hip; the upper body leans over it.
  torso_torque -= gains_.upper_share * lift * gains_.upper_height * limbs_.scale() * Sin(s.torso);
  Push(s, side, pressure, lift, (torso_torque - (pressure.x - s.hip.x) * lift) / height);
}

/// Returns the leg's pressure point: `x`, or the nearest point of its sole.
b2Vec2 CharacterControl::Sole(const CharacterSense& s, int side, float x) const {
  const b2Vec2 ankle = s.legs[side].ankle;
  const CharacterShape& shape = limbs_.shape();
  const float rim = gains_.sole_rim * limbs_.scale();
  return b2Vec2(std::clamp(x, ankle.x - shape.heel + rim, ankle.x + shape.toe - rim),
                ankle.y - shape.ankle);
}

/// Treats the legs as massless: the torque in each joint is the ground's force about it. In a step,
/// if the knee cannot bear the force, it is reduced to what the knee bears: an ankle with the full
/// torque would turn the foot over its toe, as in a jump. Not so while standing or getting up:
/// there it cost some of the climbs over a ledge (docs/lab.md).
void CharacterControl::Push(const CharacterSense& s, int side, b2Vec2 pressure, float lift,
                            float forward) {
  const b2Vec2 force(std::clamp(forward, -gains_.grip * lift, gains_.grip * lift), lift);
  const LegSense& leg = s.legs[side];
  const auto torque_at = [&](b2Vec2 joint) { return -b2Cross(pressure - joint, force); };
  const float knee = torque_at(leg.knee), bound = limbs_.bound(Knee(side));
  const bool yields = memory_.mode == CharacterMode::kStep && std::abs(knee) > bound;
  const float borne = yields ? bound / std::abs(knee) : 1;
  limbs_.Torque(Hip(side), borne * torque_at(leg.hip));
  limbs_.Torque(Knee(side), knee);
  limbs_.Torque(Ankle(side), borne * torque_at(leg.ankle));
}

/// Returns absolute angles of thigh and shank that put the ankle at `way` from the hip, knee
/// forward.
CharacterControl::LegPose CharacterControl::PoseFor(b2Vec2 way) const {
  const float a = limbs_.shape().thigh, b = limbs_.shape().shank;
  const float distance = std::clamp(way.Length(), std::abs(a - b) + 0.25f * a, 0.995f * (a + b));
  const float down = std::atan2(way.x, -way.y);
  const float at_hip = std::acos((a * a + distance * distance - b * b) / (2 * a * distance));
  const float at_knee = std::acos((a * a + b * b - distance * distance) / (2 * a * b));
  return {down + at_hip, at_knee - b2_pi};
}

/// Moves the ankle to a moving point, and the foot to an angle, all in the own frame.
void CharacterControl::Reach(const CharacterSense& s, int side, b2Vec2 ankle, b2Vec2 velocity,
                             float foot, float stiffness) {
  const b2Vec2 way = ankle - s.hip;
  const LegPose now = PoseFor(way);
  const LegPose then = PoseFor(way + kDerivativeStep * (velocity - s.hip_velocity));
  const float thigh_spin = (then.thigh - now.thigh) / kDerivativeStep;
  const float knee_spin = (then.knee - now.knee) / kDerivativeStep;
  Pose(Hip(side), now.thigh - s.torso, stiffness, thigh_spin - s.torso_spin, gains_.hip_rate);
  Pose(Knee(side), now.knee, stiffness, knee_spin);
  Pose(Ankle(side), foot - s.legs[side].shank, gains_.ankle_stiffness);
}

void CharacterControl::Arms(float left, float right, float elbow) {
  Pose(kShoulderLeft, left, gains_.arm_stiffness);
  Pose(kShoulderRight, right, gains_.arm_stiffness);
  Pose(kElbowLeft, elbow, gains_.arm_stiffness);
  Pose(kElbowRight, elbow, gains_.arm_stiffness);
  Pose(kNeck, 0, gains_.neck_stiffness);
}

void CharacterControl::Stand(const CharacterSense& s) {
  const CharacterShape& shape = limbs_.shape();
  const bool both = s.legs[0].down && s.legs[1].down;
  const bool none = !s.legs[0].down && !s.legs[1].down;
  float low = 0, high = 0, ground_y = 0, ground_vx = 0, ground_vy = 0, count = 0;
  for (const LegSense& leg : s.legs) {
    if (!leg.down && !none) continue;
    low = count == 0 ? leg.ankle.x - shape.heel : std::min(low, leg.ankle.x - shape.heel);
    high = count == 0 ? leg.ankle.x + shape.toe : std::max(high, leg.ankle.x + shape.toe);
    ground_y += leg.ankle.y - shape.ankle;
    ground_vx += leg.ground_velocity.x;
    ground_vy += leg.ground_velocity.y;
    ++count;
  }
  ground_y /= count;
  ground_vx /= count;
  ground_vy /= count;
  const float capture = s.centre.x + (s.velocity.x - ground_vx) / Omega(s, ground_y);
  const float middle = (low + high) / 2;
  const float margin = gains_.capture_margin * limbs_.scale();
  memory_.speed = 0;
  const bool lost = capture < low - margin || capture > high + margin;
  if ((lost || std::abs(drive_) > 0.1f) && !none) {
    // The foot nearer to the side of the fall supports.
    const bool forward = lost ? capture > middle : drive_ > 0;
    const bool left_ahead = s.legs[0].ankle.x > s.legs[1].ankle.x;
    BeginStep(s, both ? (forward == left_ahead ? 0 : 1) : (s.legs[0].down ? 0 : 1));
    Enter(CharacterMode::kStep);
    StepOn(s, 0);
    return;
  }
  const float pressure = capture + gains_.capture_gain * (capture - middle);
  const float lift = Lift(s, ground_y, gains_.stand_height * shape.hip, ground_vy);
  const float torso = TorsoTorque(s, 0);
  float share = 0.5f;  // the left leg's
  const float apart = s.legs[1].ankle.x - s.legs[0].ankle.x;
  if (std::abs(apart) > 0.1f * shape.hip) {
    share = std::clamp((s.legs[1].ankle.x - pressure) / apart, 0.1f, 0.9f);
  }
  if (!both && !none) share = s.legs[0].down ? 1.0f : 0.0f;
  for (int side = 0; side < 2; ++side) {
    const float part = side == 0 ? share : 1 - share;
    if (part > 0) {
      Bear(s, side, pressure, part * lift, part * torso);
    } else {
      Reach(s, side, b2Vec2(s.legs[side].ankle.x, ground_y + shape.ankle), s.hip_velocity, 0,
            gains_.swing_stiffness);
    }
  }
  Arms(0.1f, -0.1f, 0.3f);
}

}  // namespace seam
