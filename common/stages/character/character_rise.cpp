/// CharacterControl: falling and getting up.

#include <algorithm>
#include <cmath>

#include "common/stages/character/character_control.h"
#include "common/stages/character/character_gains.h"

namespace seam {
namespace {

/// A pose of the way up, both sides the same. The poses were found by random search over them (some
/// hundred falls a minute), for the quickest rise from the worst of several ways to lie.
struct RiseFrame {
  float seconds;                            ///< until it is reached, from the one before
  float hip, knee, ankle, shoulder, elbow;  ///< rad
};

constexpr int kFrames = 4;
/// Phases of CharacterMode::kRise: frames from the back, frames from the front, then up.
constexpr int kFromFront = kFrames, kUp = 2 * kFrames;

constexpr RiseFrame kRise[2 * kFrames] = {
    // On the back: draw the legs up, push with the arms behind, roll forward over the feet.
    {0.49f, -0.70f, -2.43f, -0.77f, -0.85f, 1.21f},
    {0.71f, 2.40f, -2.22f, 0.90f, -0.59f, 0.04f},
    {0.15f, 2.21f, -2.31f, 0.63f, 0.08f, 0.43f},
    {0.19f, 0.85f, -1.53f, 0.47f, 2.17f, 0.29f},
    // On the front: arch, kick the legs below, roll back over them.
    {0.33f, -0.57f, -1.69f, -0.17f, -1.05f, 2.30f},
    {0.16f, 0.62f, 0.00f, 0.90f, 0.50f, 1.00f},
    {0.28f, 2.40f, -2.60f, 0.90f, 1.30f, 0.86f},
    {0.15f, 2.40f, -2.50f, 0.90f, 1.59f, 0.62f},
};

}  // namespace

void CharacterControl::Fall(const CharacterSense& s) {
  const bool back = s.torso > 0;
  // Hands towards the ground, chin on the chest.
  Pose(kNeck, back ? 0.5f : -0.4f, 0.5f * gains_.neck_stiffness);
  for (int side = 0; side < 2; ++side) {
    Pose(Shoulder(side), back ? -0.8f : 1.3f, gains_.fall_stiffness);
    Pose(Elbow(side), 0.5f, gains_.fall_stiffness);
    Pose(Hip(side), 0.4f, gains_.fall_stiffness);
    Pose(Knee(side), -0.6f, gains_.fall_stiffness);
    Pose(Ankle(side), 0, gains_.fall_stiffness);
  }
  const bool still = s.velocity.LengthSquared() < 0.1f && std::abs(s.torso_spin) < 0.5f;
  if (memory_.time > gains_.fall_max || (still && memory_.time > gains_.fall_min)) {
    Enter(CharacterMode::kRise);
    memory_.phase = back ? 0 : kFromFront;
  }
}

void CharacterControl::Rise(const CharacterSense& s, float h) {
  memory_.phase_time += h;
  if (memory_.phase == kUp) {
    Up(s);
    return;
  }
  const RiseFrame& to = kRise[memory_.phase];
  const bool first = memory_.phase % kFrames == 0;
  const RiseFrame& from = kRise[first ? memory_.phase : memory_.phase - 1];
  const float t = std::min(1.0f, memory_.phase_time / to.seconds);
  const auto at = [&](float RiseFrame::*angle) {
    return from.*angle + t * (to.*angle - from.*angle);
  };
  for (int side = 0; side < 2; ++side) {
    Pose(Hip(side), at(&RiseFrame::hip), gains_.rise_stiffness);
    Pose(Knee(side), at(&RiseFrame::knee), gains_.rise_stiffness);
    Pose(Ankle(side), at(&RiseFrame::ankle), gains_.ankle_stiffness);
    Pose(Shoulder(side), at(&RiseFrame::shoulder), gains_.arm_stiffness);
    Pose(Elbow(side), at(&RiseFrame::elbow), gains_.arm_stiffness);
  }
  Pose(kNeck, 0.3f, gains_.neck_stiffness);
  if (memory_.phase_time < to.seconds) return;
  memory_.phase = memory_.phase % kFrames == kFrames - 1 ? kUp : memory_.phase + 1;
  memory_.phase_time = 0;
}

/// Squatting over its feet: up, the torso leaning forward the more the deeper it is.
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
  const float proposed = std::min(gains_.stand_height, height + 0.12f);
  const float lift = Lift(s, ground_y, proposed * shape.hip, 0);
  const float torso = TorsoTorque(s, -0.9f * std::clamp(1.2f - height, 0.0f, 1.0f));
  for (int side = 0; side < 2; ++side) Bear(s, side, pressure, 0.5f * lift, 0.5f * torso);
  Arms(0.8f, 0.8f, 0.3f);
}

}  // namespace seam
