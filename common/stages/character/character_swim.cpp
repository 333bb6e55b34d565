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

/// m from the ground below the chest up to the water's level; large where no ground is near.
float CharacterControl::WaterOverGround(const CharacterSense& s) const {
  const b2Vec2 chest = limbs_.Own(limbs_.body(kTorso)->GetPosition());
  const float depth = ChestDepth(s);
  const GroundPoint ground = limbs_.GroundBelow(chest, 2 * limbs_.scale());
  return ground.found ? chest.y + depth - ground.point.y : 1000;
}

/// Legs that tread: upright, at rest.
CharacterControl::Legs CharacterControl::TreadLegs(const CharacterSense& s, float leg) const {
  const CharacterGains& g = gains_;
  const float error = std::clamp(s.torso + g.tread_lean, -1.0f, 1.0f);
  const float skew = g.tread_skew * error + g.tread_skew_rate * s.torso_spin;
  return {g.tread_hip + skew + g.tread_sine * Sine(leg),
          g.tread_knee + g.tread_knee_sine * Sine(leg + g.tread_knee_phase), g.tread_ankle};
}

/// Legs that beat; `share` of the drive, negative backwards.
CharacterControl::Legs CharacterControl::BeatLegs(const CharacterSense& s, float leg,
                                                  float share) const {
  const CharacterGains& g = gains_;
  const bool back = share < 0;
  const float size = g.swim_slow_size + std::abs(share) * (1 - g.swim_slow_size);
  const float lean = back ? g.swim_lean_back : g.swim_lean + share * g.swim_lean_more;
  const float error = std::clamp(s.torso + lean, -0.8f, 0.8f);
  const float skew =
      g.swim_skew * error + g.swim_skew_rate * s.torso_spin + (back ? g.swim_skew_back : 0);
  const float beat = std::round(g.swim_kicks) * leg;
  return {g.hip_middle + skew + size * g.hip_sine * Sine(beat),
          g.knee_middle + size * g.knee_sine * Sine(beat + g.knee_phase),
          g.ankle_middle + size * g.ankle_sine * Sine(beat + g.ankle_phase)};
}

void CharacterControl::PoseLegs(const Legs& tread, const Legs& beat, float share, int side) {
  const auto mixed = [share](float rest, float swim) { return rest + share * (swim - rest); };
  Pose(Hip(side), mixed(tread.hip, beat.hip), gains_.swim_hip);
  Pose(Knee(side), mixed(tread.knee, beat.knee), gains_.swim_knee);
  Pose(Ankle(side), mixed(tread.ankle, beat.ankle), gains_.swim_ankle);
}

/// Before a ledge, hands busy.
void CharacterControl::Tread(const CharacterSense& s, float h) {
  memory_.phase_time += gains_.tread_hz * h;
  memory_.phase_time -= std::floor(memory_.phase_time);
  for (int side = 0; side < 2; ++side) {
    const Legs legs = TreadLegs(s, memory_.phase_time + 0.5f * static_cast<float>(side));
    PoseLegs(legs, legs, 0, side);
  }
}

void CharacterControl::Swim(const CharacterSense& s, float h) {
  const CharacterGains& g = gains_;
  // The drive comes slowly, and the stroke with it: a sudden one turns the body over.
  memory_.speed += std::clamp(drive_ - memory_.speed, -g.swim_ramp * h, g.swim_ramp * h);
  const float share = std::clamp(memory_.speed, -1.0f, 1.0f), size = std::abs(share);
  const float swims = std::min(size / g.swim_full, 1.0f);
  // Drag goes by the square of the speed: the same stroke in reverse pushes the other way.
  const float turning = g.swim_slow_hz + size * (g.swim_hz - g.swim_slow_hz);
  const float hz = swims * (share < 0 ? -turning : turning) + (1 - swims) * g.tread_hz;
  memory_.phase_time += hz * h;
  memory_.phase_time -= std::floor(memory_.phase_time);
  const float arms = g.tread_arms_skew * std::clamp(s.torso + g.tread_lean, -1.0f, 1.0f);
  for (int side = 0; side < 2; ++side) {
    const float turn = memory_.phase_time + 0.5f * static_cast<float>(side);
    if (swims < 0.5f) {  // one arm before, one behind
      Pose(Shoulder(side), (side == 0 ? g.tread_arms : -g.tread_arms) + arms, g.swim_shoulder);
      Pose(Elbow(side), side == 0 ? g.tread_elbow : 0.05f, g.swim_elbow);
    } else {  // from overhead down before the body
      const float turned = -2 * b2_pi * turn + g.shoulder_sine * Sine(turn + g.shoulder_phase);
      Pose(Shoulder(side), turned, swims * g.swim_shoulder, -2 * b2_pi * hz);
      Pose(Elbow(side), g.elbow_middle + g.elbow_sine * Sine(turn + g.elbow_phase), g.swim_elbow);
    }
    PoseLegs(TreadLegs(s, turn), BeatLegs(s, turn, share), swims, side);
  }
  // The face out of the water.
  Pose(kNeck, std::clamp(-s.torso, -0.5f, 0.5f), g.neck_stiffness);
}

}  // namespace seam
