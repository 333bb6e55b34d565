/// CharacterControl: swimming. What moves the body is the water's drag, nothing else: arms that
/// turn, and a sine in each joint of arms and legs, as in Tan, Gu, Turk and Liu, "Articulated
/// Swimming Creatures", 2011. The legs' skew keeps the torso's lean.

#include <algorithm>
#include <cmath>

#include "common/scene/water.h"
#include "common/stages/character/character_control.h"

namespace seam {
namespace {

/// Of a sine, `phase` in turns.
float Sine(float phase) { return std::sin(2 * b2_pi * (phase - std::floor(phase))); }

}  // namespace

/// m of the chest below the level of the water it is in; negative above it or without water.
float CharacterControl::ChestDepth(const CharacterSense& s) const {
  const b2Vec2 chest = limbs_.Own(limbs_.body(kTorso)->GetPosition());
  const float x = character_.facing * chest.x;
  float depth = -1000;
  for (const Water& water : world_.scene.waters) {
    const bool inside = x > water.min.x() && x < water.max.x() && s.centre.y > water.min.y();
    if (inside) depth = std::max(depth, water.max.y() - chest.y);
  }
  return depth;
}

/// At rest, upright: the arms lie before and behind at the surface and the legs tread.
void CharacterControl::Tread(const CharacterSense& s, float h) {
  const CharacterGains& g = gains_;
  TreadLegs(s, h);
  const float arms = g.tread_arms_skew * std::clamp(s.torso + g.tread_lean, -1.0f, 1.0f);
  for (int side = 0; side < 2; ++side) {
    Pose(Shoulder(side), (side == 0 ? g.tread_arms : -g.tread_arms) + arms, g.swim_shoulder);
    Pose(Elbow(side), side == 0 ? g.tread_elbow : 0.05f, g.swim_elbow);
  }
}

void CharacterControl::TreadLegs(const CharacterSense& s, float h) {
  const CharacterGains& g = gains_;
  memory_.phase_time += g.tread_hz * h;
  memory_.phase_time -= std::floor(memory_.phase_time);
  const float error = std::clamp(s.torso + g.tread_lean, -1.0f, 1.0f);
  const float skew = g.tread_skew * error + g.tread_skew_rate * s.torso_spin;
  for (int side = 0; side < 2; ++side) {
    const float leg = memory_.phase_time + 0.5f * static_cast<float>(side);
    Pose(Hip(side), g.tread_hip + skew + g.tread_sine * Sine(leg), g.swim_hip);
    Pose(Knee(side), g.tread_knee + g.tread_knee_sine * Sine(leg + g.tread_knee_phase),
         g.swim_knee);
    Pose(Ankle(side), g.tread_ankle, g.swim_ankle);
  }
}

void CharacterControl::Swim(const CharacterSense& s, float h) {
  const CharacterGains& g = gains_;
  // The drive comes slowly: a sudden stroke turns the body over.
  memory_.speed += std::clamp(drive_ - memory_.speed, -g.swim_ramp * h, g.swim_ramp * h);
  const float share = std::min(std::abs(memory_.speed), 1.0f);
  const bool back = memory_.speed < 0;
  // The face out of the water.
  Pose(kNeck, std::clamp(-s.torso, -0.5f, 0.5f), g.neck_stiffness);
  if (share < 0.05f) return Tread(s, h);
  // Drag goes by the square of the speed: the same stroke in reverse pushes the other way.
  const float hz = g.swim_slow_hz + share * (g.swim_hz - g.swim_slow_hz);
  memory_.phase_time += (back ? -hz : hz) * h;
  memory_.phase_time -= std::floor(memory_.phase_time);
  const float phase = memory_.phase_time;
  const float size = g.swim_slow_size + share * (1 - g.swim_slow_size);
  const float lean = back ? g.swim_lean_back : g.swim_lean + share * g.swim_lean_more;
  const float error = std::clamp(s.torso + lean, -0.8f, 0.8f);
  const float skew =
      g.swim_skew * error + g.swim_skew_rate * s.torso_spin + (back ? g.swim_skew_back : 0);
  for (int side = 0; side < 2; ++side) {
    const float arm = phase + 0.5f * static_cast<float>(side);
    const float leg = std::round(g.swim_kicks) * phase + 0.5f * static_cast<float>(side);
    // From overhead down before the body.
    const float turned = -2 * b2_pi * arm + g.shoulder_sine * Sine(arm + g.shoulder_phase);
    Pose(Shoulder(side), turned, g.swim_shoulder, (back ? 2 : -2) * b2_pi * hz);
    Pose(Elbow(side), g.elbow_middle + g.elbow_sine * Sine(arm + g.elbow_phase), g.swim_elbow);
    Pose(Hip(side), g.hip_middle + skew + size * g.hip_sine * Sine(leg), g.swim_hip);
    Pose(Knee(side), g.knee_middle + size * g.knee_sine * Sine(leg + g.knee_phase), g.swim_knee);
    Pose(Ankle(side), g.ankle_middle + size * g.ankle_sine * Sine(leg + g.ankle_phase),
         g.swim_ankle);
  }
}

}  // namespace seam
