/// CharacterControl: standing and stepping.

#include <algorithm>
#include <cmath>

#include "common/stages/character/character_control.h"
#include "common/stages/character/character_gains.h"

namespace seam {
namespace {

/// m beside the wished foothold, where it looks for a flat one, and how many on either side.
constexpr float kAsideMax = 0.32f;
constexpr int kAsides = 8;

float Smooth(float t) {
  const float u = std::clamp(t, 0.0f, 1.0f);
  return u * u * (3 - 2 * u);
}

}  // namespace

float CharacterControl::TorsoTorque(const CharacterSense& s, float lean) const {
  return unit_ * (gains_.torso_stiffness * (lean - s.torso) - gains_.torso_damping * s.torso_spin);
}

float CharacterControl::Lift(const CharacterSense& s, float ground_y, float hip_height,
                             float ground_vy) const {
  const float error = ground_y + hip_height - s.hip.y;
  const float proposed = s.mass * (gravity_ + gains_.height_stiffness * error / limbs_.scale() -
                                   gains_.height_damping * (s.hip_velocity.y - ground_vy));
  return std::clamp(proposed, gains_.lift_min * s.mass * gravity_,
                    gains_.lift_max * s.mass * gravity_);
}

/// The leg pushes the ground with `lift` N at `pressure_x`, and the torso with `torso_torque`. The
/// force's horizontal part follows from the two.
void CharacterControl::Bear(const CharacterSense& s, int side, float pressure_x, float lift,
                            float torso_torque) {
  const b2Vec2 pressure = Sole(s, side, pressure_x);
  const float height = std::max(0.2f * limbs_.shape().hip, s.hip.y - pressure.y);
  // The push goes through the hip; the body above leans over it.
  torso_torque -=
      gains_.upper_share * lift * gains_.upper_height * limbs_.scale() * std::sin(s.torso);
  Push(s, side, pressure, lift, (torso_torque - (pressure.x - s.hip.x) * lift) / height);
}

/// The leg's pressure point: `x`, or the nearest on its sole.
b2Vec2 CharacterControl::Sole(const CharacterSense& s, int side, float x) const {
  const b2Vec2 ankle = s.legs[side].ankle;
  const CharacterShape& shape = limbs_.shape();
  const float rim = gains_.sole_rim * limbs_.scale();
  return b2Vec2(std::clamp(x, ankle.x - shape.heel + rim, ankle.x + shape.toe - rim),
                ankle.y - shape.ankle);
}

/// The legs are taken as massless: the torque in each joint is the ground's force about it.
void CharacterControl::Push(const CharacterSense& s, int side, b2Vec2 pressure, float lift,
                            float forward) {
  const b2Vec2 force(std::clamp(forward, -gains_.grip * lift, gains_.grip * lift), lift);
  const LegSense& leg = s.legs[side];
  const auto torque_at = [&](b2Vec2 joint) { return -b2Cross(pressure - joint, force); };
  limbs_.Torque(Hip(side), torque_at(leg.hip));
  limbs_.Torque(Knee(side), torque_at(leg.knee));
  limbs_.Torque(Ankle(side), torque_at(leg.ankle));
}

/// Angles of thigh and shank, absolute, that bring the ankle `way` from the hip, the knee forward.
CharacterControl::LegPose CharacterControl::PoseFor(b2Vec2 way) const {
  const float a = limbs_.shape().thigh, b = limbs_.shape().shank;
  const float distance = std::clamp(way.Length(), std::abs(a - b) + 0.25f * a, 0.995f * (a + b));
  const float down = std::atan2(way.x, -way.y);
  const float at_hip = std::acos((a * a + distance * distance - b * b) / (2 * a * distance));
  const float at_knee = std::acos((a * a + b * b - distance * distance) / (2 * a * b));
  return {down + at_hip, at_knee - b2_pi};
}

/// Leads the ankle to a point that moves, and the foot to an angle, all in the own frame.
void CharacterControl::Reach(const CharacterSense& s, int side, b2Vec2 ankle, b2Vec2 velocity,
                             float foot, float stiffness) {
  constexpr float kAhead = 0.01f;  // s, for the rates of the angles
  const b2Vec2 way = ankle - s.hip;
  const LegPose now = PoseFor(way);
  const LegPose then = PoseFor(way + kAhead * (velocity - s.hip_velocity));
  const float thigh_spin = (then.thigh - now.thigh) / kAhead;
  const float knee_spin = (then.knee - now.knee) / kAhead;
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
    // Away from where it falls to: the foot that is nearer there bears.
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
  float share = 0.5f;  // of the left
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

float CharacterControl::StepTime() const { return gains_.step_time * std::sqrt(limbs_.scale()); }

void CharacterControl::BeginStep(const CharacterSense& s, int stance) {
  memory_.stance = stance;
  memory_.step = 0;
  memory_.from = s.legs[1 - stance].ankle;
  memory_.to = memory_.from.x;
}

/// Of the ankle, m: where the pendulum goes on at the wished speed.
float CharacterControl::WishedFoothold(const CharacterSense& s, float support_x) const {
  const CharacterShape& shape = limbs_.shape();
  const LegSense& stance = s.legs[memory_.stance];
  const float omega = Omega(s, stance.ankle.y - shape.ankle);
  const float left = std::max(StepTime() - memory_.step, 0.0f);
  // The divergent component at the end of the step, if the pressure stays where it is.
  const float now = s.centre.x + (s.velocity.x - stance.ground_velocity.x) / omega;
  const float then = support_x + (now - support_x) * std::exp(omega * left);
  const float hip_then = s.hip.x + left * s.velocity.x;
  return std::clamp(then - Ahead(omega), hip_then - gains_.reach_back * limbs_.scale(),
                    hip_then + gains_.reach_max * limbs_.scale());
}

/// m by which the divergent component is to be before the ankle of the next foot.
float CharacterControl::Ahead(float omega) const {
  const CharacterShape& shape = limbs_.shape();
  return memory_.speed * StepTime() / (std::exp(omega * StepTime()) - 1) +
         (shape.toe - shape.heel) / 2;
}

/// Whether heel and toe, and `rim` m beyond them, are on one face of the ground; the foothold there
/// in any case.
bool CharacterControl::FlatAt(const CharacterSense& s, float x, float rim,
                              Foothold* foothold) const {
  const CharacterShape& shape = limbs_.shape();
  const float ground_y = s.legs[memory_.stance].ankle.y - shape.ankle;
  const float from_y = ground_y + 0.5f * shape.hip, depth = 1.2f * shape.hip;
  const GroundPoint heel = limbs_.GroundBelow(b2Vec2(x - shape.heel - rim, from_y), depth);
  const GroundPoint toe = limbs_.GroundBelow(b2Vec2(x + shape.toe + rim, from_y), depth);
  const float heel_y = heel.found ? heel.point.y : ground_y;
  const float toe_y = toe.found ? toe.point.y : ground_y;
  const float length = shape.heel + shape.toe + 2 * rim;
  // One face: what its two ends say of its slope is also what its normal says.
  const bool flat = std::abs(toe_y - heel_y) < gains_.slope_max * length &&
                    (heel.normal - toe.normal).Length() < 0.3f &&
                    std::abs((toe_y - heel_y) * heel.normal.y + length * heel.normal.x) <
                        gains_.uneven * limbs_.scale();
  foothold->ankle.Set(x, std::max(heel_y, toe_y) + shape.ankle);
  foothold->slope = 0;
  if (!flat) return false;
  foothold->slope = std::atan2(toe_y - heel_y, length);
  foothold->ankle.y = heel_y + (toe_y - heel_y) * (shape.heel + rim) / length + shape.ankle;
  return true;
}

/// Not across the edge of a stair, if there is room beside it.
CharacterControl::Foothold CharacterControl::NextFoothold(const CharacterSense& s,
                                                          float support_x) const {
  const float wished = WishedFoothold(s, support_x), scale = limbs_.scale();
  Foothold next;
  if (FlatAt(s, wished, 0, &next)) return next;
  const Foothold edge = next;
  // The nearest of what lies beside it; one that was chosen before has a start.
  float nearest = kAsideMax * scale;
  bool found = false;
  for (int i = -kAsides; i <= kAsides; ++i) {
    const float x = wished + static_cast<float>(i) / kAsides * kAsideMax * scale;
    float far = std::abs(x - wished);
    if (std::abs(x - memory_.to) > gains_.edge_keep * scale) far += gains_.edge_keep * scale;
    Foothold other;
    if (far >= nearest || !FlatAt(s, x, gains_.edge_rim * scale, &other)) continue;
    nearest = far;
    next = other;
    found = true;
  }
  return found ? next : edge;
}

/// By how much faster than usual the step must be for the divergent component to be where it is
/// wanted when the foot stands at `foothold_x`. After Khadiv and others, "Step Timing Adjustment: A
/// Step toward Generating Robust Gaits", 2016.
float CharacterControl::StepRate(const CharacterSense& s, float support_x, float foothold_x) const {
  const LegSense& stance = s.legs[memory_.stance];
  const float omega = Omega(s, stance.ankle.y - limbs_.shape().ankle);
  const float now = s.centre.x + (s.velocity.x - stance.ground_velocity.x) / omega - support_x;
  const float then = foothold_x + Ahead(omega) - support_x;
  const float left = StepTime() - memory_.step;
  if (left < 0.02f || std::abs(now) < 0.01f * limbs_.scale() || now * then <= 0) return 1;
  const float needed = std::log(std::max(1.02f, then / now)) / omega;
  return std::clamp(left / needed, gains_.step_rate_min, gains_.step_rate_max);
}

/// Of the swinging foot, at `time` s: up, over, down to where it is to stand.
b2Vec2 CharacterControl::SwingAt(float time, const Foothold& to) const {
  const float whole = StepTime();
  const float t = time / whole;
  const b2Vec2 from = memory_.from;
  // Onto a stair it goes up before it goes on.
  const bool stair = to.ankle.y > from.y + 0.05f * limbs_.scale() && std::abs(to.slope) < 0.05f;
  const float wait = stair ? gains_.stair_wait : 0;
  const float lifted = stair ? gains_.stair_lifted : gains_.lifted;
  const float x = from.x + (to.ankle.x - from.x) * Smooth((t - wait) / (gains_.arrive - wait));
  const float top = std::max(from.y, to.ankle.y) +
                    (stair ? gains_.stair_clearance : gains_.clearance) * limbs_.scale();
  const float y = t < 0.5f ? from.y + (top - from.y) * Smooth(t / lifted)
                           : top + (to.ankle.y - top) * Smooth((t - 0.5f) / 0.5f);
  const float late = t > 1 ? gains_.search * limbs_.scale() * (time - whole) : 0;
  return b2Vec2(x, y - late);
}

void CharacterControl::Swing(const CharacterSense& s, int side, const Foothold& to) {
  constexpr float kAhead = 0.01f;  // s, for the foot's velocity
  const b2Vec2 now = SwingAt(memory_.step, to);
  const b2Vec2 then = SwingAt(memory_.step + kAhead, to);
  Reach(s, side, now, 1 / kAhead * (then - now), to.slope, gains_.swing_stiffness);
}

void CharacterControl::StepOn(const CharacterSense& s, float h) {
  const CharacterShape& shape = limbs_.shape();
  const float most = drive_ > 0 ? gains_.run_speed_max : gains_.speed_back;
  const float proposed = most * std::sqrt(limbs_.scale()) * drive_;
  memory_.speed +=
      std::clamp(proposed - memory_.speed, -gains_.speed_rate * h, gains_.speed_rate * h);
  const float whole = StepTime();
  const int swing = 1 - memory_.stance;
  if (s.legs[swing].down && memory_.step > 0.5f * whole) {
    BeginStep(s, swing);
    const LegSense& leg = s.legs[swing];
    const float relative = s.velocity.x - leg.ground_velocity.x;
    const float capture = s.centre.x + relative / Omega(s, leg.ankle.y - shape.ankle);
    const float low = std::min(leg.ankle.x, s.legs[1 - swing].ankle.x) - shape.heel;
    const float high = std::max(leg.ankle.x, s.legs[1 - swing].ankle.x) + shape.toe;
    const float in = 0.04f * limbs_.scale();
    if (std::abs(drive_) < 0.1f && std::abs(relative) < 0.6f && capture > low + in &&
        capture < high - in && s.legs[1 - swing].down) {
      Enter(CharacterMode::kStand);
      Stand(s);
      return;
    }
  }
  const LegSense& stance = s.legs[memory_.stance];
  const float ground_y = stance.ankle.y - shape.ankle;
  const float relative = s.velocity.x - stance.ground_velocity.x;
  const float middle = stance.ankle.x + (shape.toe - shape.heel) / 2;
  const float pressure =
      Sole(s, memory_.stance, middle + gains_.step_pressure * (relative - memory_.speed)).x;
  const int swing_side = 1 - memory_.stance;
  const float support = middle + gains_.step_trust * (pressure - middle);
  const Foothold next = NextFoothold(s, support);
  memory_.to = next.ankle.x;
  memory_.step += h * StepRate(s, support, next.ankle.x);
  Swing(s, swing_side, next);
  // The height that the hip keeps is above the line from foot to foot.
  const b2Vec2 way = next.ankle - stance.ankle;
  const bool apart = std::abs(way.x) > 0.15f * shape.hip;
  const float rise = apart ? std::clamp(way.y / way.x, -gains_.slope_max, gains_.slope_max) : 0;
  const float along = apart ? std::clamp((s.hip.x - stance.ankle.x) / way.x, 0.0f, 1.0f) : 0;
  const float floor_y = ground_y + along * rise * way.x;
  const float floor_vy = stance.ground_velocity.y + rise * memory_.speed;
  const float lean = -gains_.lean * std::abs(memory_.speed);
  const float torso = TorsoTorque(s, lean) + limbs_.told(Hip(swing_side));
  Bear(s, memory_.stance, pressure,
       Lift(s, floor_y, (gains_.step_height - gains_.crouch * std::abs(memory_.speed)) * shape.hip,
            floor_vy),
       torso);
  Arms(-0.8f * s.legs[0].thigh, -0.8f * s.legs[1].thigh, 0.7f);
}

}  // namespace seam
