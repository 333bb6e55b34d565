/// CharacterControl: falling and getting up.

#include <algorithm>
#include <cmath>

#include "common/base/trig.h"
#include "common/stages/character/character_control.h"
#include "common/stages/character/character_gains.h"

namespace seam {
namespace {

/// A pose of the way up, equal on both sides, by the gains that define it.
struct RiseFrame {
  float CharacterGains::*seconds;  ///< duration from the previous pose
  float CharacterGains::*hip;      ///< rad; so are the next four
  float CharacterGains::*knee;
  float CharacterGains::*ankle;
  float CharacterGains::*shoulder;
  float CharacterGains::*elbow;
  float CharacterGains::*seconds_slope;  ///< s per rad of the ground's slope, up forwards
  float CharacterGains::*hip_slope;      ///< rad per rad; so are the next two
  float CharacterGains::*knee_slope;
  float CharacterGains::*shoulder_slope;
};

#define SEAM_FRAME(name)                                                                     \
  {                                                                                          \
    &CharacterGains::name##_time, &CharacterGains::name##_hip, &CharacterGains::name##_knee, \
        &CharacterGains::name##_ankle, &CharacterGains::name##_shoulder,                     \
        &CharacterGains::name##_elbow, &CharacterGains::name##_time_slope,                   \
        &CharacterGains::name##_hip_slope, &CharacterGains::name##_knee_slope,               \
        &CharacterGains::name##_shoulder_slope                                               \
  }

constexpr int kFrames = 4;
/// Phases of CharacterMode::kRise: frames from the back, frames from the front, then up.
constexpr int kFromFront = kFrames, kUp = 2 * kFrames;
static_assert(kUp == kPhaseMost);

constexpr RiseFrame kRise[2 * kFrames] = {
    SEAM_FRAME(back1),  SEAM_FRAME(back2),  SEAM_FRAME(back3),  SEAM_FRAME(back4),
    SEAM_FRAME(front1), SEAM_FRAME(front2), SEAM_FRAME(front3), SEAM_FRAME(front4),
};
#undef SEAM_FRAME

/// rad; steeper ground counts as this steep.
constexpr float kSlopeKnown = 0.5f;

}  // namespace

void CharacterControl::Fall(const CharacterSense& s) {
  const bool back = s.torso > 0;
  // Hands towards the ground, chin on the chest.
  Pose(kNeck, back ? 0.5f : -0.4f, 0.5f * gains_.neck_stiffness, 0, gains_.rise_rate);
  for (int side = 0; side < 2; ++side) {
    Pose(Shoulder(side), back ? -0.8f : 1.3f, gains_.fall_stiffness, 0, gains_.rise_rate);
    Pose(Elbow(side), 0.5f, gains_.fall_stiffness, 0, gains_.rise_rate);
    Pose(Hip(side), 0.4f, gains_.fall_stiffness, 0, gains_.rise_rate);
    Pose(Knee(side), -0.6f, gains_.fall_stiffness, 0, gains_.rise_rate);
    Pose(Ankle(side), 0, gains_.fall_stiffness, 0, gains_.rise_rate);
  }
  const bool still = s.velocity.LengthSquared() < 0.1f && std::abs(s.torso_spin) < 0.5f;
  if (memory_.time > gains_.fall_max || (still && memory_.time > gains_.fall_min)) {
    Enter(CharacterMode::kRise);
    memory_.phase = back ? 0 : kFromFront;
  }
}

/// Returns the slope of the ground below the middle of the body, rad, uphill forwards; 0 without
/// ground.
float CharacterControl::SlopeBelow(const CharacterSense& s) const {
  const float aside = 0.25f * limbs_.shape().hip, above = 0.4f * limbs_.shape().hip;
  const b2Vec2 from = s.centre + b2Vec2(0, above);
  const GroundPoint back = limbs_.GroundBelow(from - b2Vec2(aside, 0), 4 * above);
  const GroundPoint front = limbs_.GroundBelow(from + b2Vec2(aside, 0), 4 * above);
  if (!back.found || !front.found) return 0;
  const float slope = std::atan2(front.point.y - back.point.y, 2 * aside);
  return std::clamp(slope, -kSlopeKnown, kSlopeKnown);
}

/// Returns the angles of hips and knees that bring the feet flat below the centre of mass.
CharacterControl::LegPose CharacterControl::Gathered(const CharacterSense& s, float place,
                                                     float lead, float slope) const {
  const CharacterShape& shape = limbs_.shape();
  const float ground_y = s.centre.y - 0.4f * shape.hip;
  const float x = s.centre.x + place * limbs_.scale() + lead * s.velocity.x / Omega(s, ground_y);
  const GroundPoint ground =
      limbs_.GroundBelow(b2Vec2(x, s.centre.y + 0.2f * shape.hip), 1.5f * shape.hip);
  const float y = ground.found ? ground.point.y : s.hip.y - 0.5f * shape.hip;
  LegPose pose = PoseFor(b2Vec2(x, y + shape.ankle / Cos(slope)) - s.hip);
  // As a joint's angle: within half a turn of straight.
  const float hip = pose.thigh - s.torso;
  pose.thigh = hip - 2 * b2_pi * std::round(hip / (2 * b2_pi));
  return pose;
}

/// Returns true if the body is on both soles and balanced over them, in whatever way it came there.
bool CharacterControl::Squats(const CharacterSense& s) const {
  const bool bears = s.legs[0].down && s.legs[1].down && !s.lying;
  const bool calm =
      std::abs(s.torso) < gains_.squat_tilt && std::abs(s.torso_spin) < gains_.squat_spin;
  if (!bears || !calm) return false;
  const CharacterShape& shape = limbs_.shape();
  const float ground_y = std::min(s.legs[0].ankle.y, s.legs[1].ankle.y) - shape.ankle;
  const float capture = s.centre.x + s.velocity.x / Omega(s, ground_y);
  const float low = std::min(s.legs[0].ankle.x, s.legs[1].ankle.x) - shape.heel;
  const float high = std::max(s.legs[0].ankle.x, s.legs[1].ankle.x) + shape.toe;
  const float rim = gains_.squat_rim * (high - low);
  return capture > low + rim && capture < high - rim;
}

void CharacterControl::Rise(const CharacterSense& s, float h) {
  memory_.phase_time += h;
  if (memory_.phase != kUp && Squats(s)) {
    memory_.phase = kUp;
    memory_.phase_time = 0;
  }
  if (memory_.phase == kUp) {
    Up(s);
    return;
  }
  const float slope = SlopeBelow(s);
  const RiseFrame& to = kRise[memory_.phase];
  const bool first = memory_.phase % kFrames == 0, last = memory_.phase % kFrames == kFrames - 1;
  const bool back = memory_.phase < kFromFront;
  const RiseFrame& from = kRise[first ? memory_.phase : memory_.phase - 1];
  const float seconds = std::max(0.02f, gains_.*to.seconds + gains_.*to.seconds_slope * slope);
  const float t = std::min(1.0f, memory_.phase_time / seconds);
  const auto at = [&](float CharacterGains::*RiseFrame::*angle) {
    return gains_.*(from.*angle) + t * (gains_.*(to.*angle) - gains_.*(from.*angle));
  };
  float hip = at(&RiseFrame::hip) + slope * at(&RiseFrame::hip_slope);
  float knee = at(&RiseFrame::knee) + slope * at(&RiseFrame::knee_slope);
  const float shoulder = at(&RiseFrame::shoulder) + slope * at(&RiseFrame::shoulder_slope);
  const float share = last ? (back ? gains_.back_gather : gains_.front_gather) : 0;
  if (share > 0) {
    const LegPose below = Gathered(s, back ? gains_.back_place : gains_.front_place,
                                   back ? gains_.back_lead : gains_.front_lead, slope);
    hip += share * (below.thigh - hip);
    knee += share * (below.knee - knee);
  }
  for (int side = 0; side < 2; ++side) {
    Pose(Hip(side), hip, gains_.rise_stiffness, 0, gains_.rise_rate);
    Pose(Knee(side), knee, gains_.rise_stiffness, 0, gains_.rise_rate);
    Pose(Ankle(side), at(&RiseFrame::ankle), gains_.ankle_stiffness, 0, gains_.rise_rate);
    Pose(Shoulder(side), shoulder, gains_.arm_stiffness, 0, gains_.rise_rate);
    Pose(Elbow(side), at(&RiseFrame::elbow), gains_.arm_stiffness, 0, gains_.rise_rate);
  }
  Pose(kNeck, 0.3f, gains_.neck_stiffness, 0, gains_.rise_rate);
  if (memory_.phase_time < seconds) return;
  memory_.phase = last ? kUp : memory_.phase + 1;
  memory_.phase_time = 0;
}

/// Rises from a squat; the deeper the squat, the more the torso leans forward.
void CharacterControl::Up(const CharacterSense& s) {
  const CharacterShape& shape = limbs_.shape();
  const float ground_y = std::min(s.legs[0].ankle.y, s.legs[1].ankle.y) - shape.ankle;
  const float middle = (s.legs[0].ankle.x + s.legs[1].ankle.x + shape.toe - shape.heel) / 2;
  const float height = (s.hip.y - ground_y) / shape.hip;
  if (height > gains_.risen && std::abs(s.torso) < 0.5f * gains_.tilt_max) {
    Enter(CharacterMode::kStand);
    Stand(s);
    return;
  }
  if (memory_.phase_time > gains_.up_max || (memory_.phase_time > 0.5f && s.lying)) {
    Enter(CharacterMode::kFall);
    return;
  }
  const float capture = s.centre.x + s.velocity.x / Omega(s, ground_y);
  const float pressure = capture + gains_.capture_gain * (capture - middle);
  const float low = std::min(s.legs[0].ankle.x, s.legs[1].ankle.x) - shape.heel;
  const float high = std::max(s.legs[0].ankle.x, s.legs[1].ankle.x) + shape.toe;
  const bool lost = capture < low || capture > high;
  if (height > gains_.up_step && lost && (s.legs[0].down || s.legs[1].down)) {
    const bool left_ahead = s.legs[0].ankle.x > s.legs[1].ankle.x;
    const bool both = s.legs[0].down == s.legs[1].down;
    BeginStep(s, both ? ((capture > high) == left_ahead ? 0 : 1) : (s.legs[0].down ? 0 : 1));
    Enter(CharacterMode::kStep);
    StepOn(s, 0);
    return;
  }
  const float proposed = std::min(gains_.stand_height, height + gains_.up_lead);
  const float lift = Lift(s, ground_y, proposed * shape.hip, 0, gains_.up_height_stiffness,
                          gains_.up_height_damping);
  const float lean = -gains_.up_lean * std::clamp(1.2f - height, 0.0f, 1.0f);
  const float torso = unit_ * (gains_.up_torso_stiffness * (lean - s.torso) -
                               gains_.up_torso_damping * s.torso_spin);
  for (int side = 0; side < 2; ++side) Bear(s, side, pressure, 0.5f * lift, 0.5f * torso);
  Arms(0.8f, 0.8f, 0.3f);
}

}  // namespace seam
