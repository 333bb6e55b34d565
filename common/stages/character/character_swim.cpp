/// CharacterControl: swimming. Only the water's drag moves the body: arms that turn, and a sine in
/// each joint of arms and legs, as in Tan, Gu, Turk and Liu, "Articulated Swimming Creatures",
/// 2011. The legs' mean angle keeps the torso's lean.

#include <algorithm>
#include <cmath>

#include "common/base/trig.h"
#include "common/scene/water.h"
#include "common/stages/character/character_control.h"

namespace seam {
namespace {

/// Phases of CharacterMode::kSwim; arms that right the torso before a stroke do so in both other
/// phases.
constexpr int kTreads = 0, kStrokes = 1, kRights = 2;

/// Returns a sine, `phase` in turns.
float Sine(float phase) { return Sin(2 * b2_pi * (phase - std::floor(phase))); }

/// Returns -1 to 1 by a phase in turns: faster up than down for a `haste` of 0 to 1, slower for 0
/// to -1. Drag grows with the square of the speed, so such a beat pushes the water one way on
/// average.
float Scull(float phase, float haste) { return Sine(phase + haste * Sine(phase) / (2 * b2_pi)); }

/// Advances by some turns, modulo whole turns.
void TurnOn(float* turns, float by) {
  *turns += by;
  *turns -= std::floor(*turns);
}

}  // namespace

/// Returns the depth of the chest below the water's level, m; negative above it or without water.
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

/// Returns the height of the water's level over the ground below the chest, m; large without ground
/// near.
float CharacterControl::WaterOverGround(const CharacterSense& s) const {
  const b2Vec2 chest = limbs_.Own(limbs_.body(kTorso)->GetPosition());
  const float depth = ChestDepth(s);
  const GroundPoint ground = limbs_.GroundBelow(chest, 2 * limbs_.scale());
  return ground.found ? chest.y + depth - ground.point.y : 1000;
}

/// Returns the legs for treading water: upright, at rest.
CharacterControl::Legs CharacterControl::TreadLegs(const CharacterSense& s, float leg) const {
  const CharacterGains& g = gains_;
  const float error = std::clamp(s.torso + g.tread_lean, -1.0f, 1.0f);
  const float skew = g.tread_skew * error + g.tread_skew_rate * s.torso_spin;
  return {g.tread_hip + skew + g.tread_sine * Scull(leg, g.tread_haste),
          g.tread_knee + g.tread_knee_sine * Scull(leg + g.tread_knee_phase, g.tread_haste),
          g.tread_ankle};
}

/// Returns the torso's forward lean during a stroke, rad.
float CharacterControl::StrokeLean(float share) const {
  return share < 0 ? gains_.swim_lean_back : gains_.swim_lean + share * gains_.swim_lean_more;
}

/// Returns the legs for kicking; `share` of the drive, negative backwards.
CharacterControl::Legs CharacterControl::BeatLegs(const CharacterSense& s, float leg,
                                                  float share) const {
  const CharacterGains& g = gains_;
  const bool back = share < 0;
  const float size = g.swim_slow_size + std::abs(share) * (1 - g.swim_slow_size);
  const float error = std::clamp(s.torso + StrokeLean(share), -0.8f, 0.8f);
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

/// Treads water in front of a ledge: with busy hands, the legs alone keep the lean.
void CharacterControl::Tread(const CharacterSense& s) {
  const CharacterGains& g = gains_;
  const float error = std::clamp(s.torso + g.tread_lean, -1.0f, 1.0f);
  const float skew = g.climb_tread_skew * error + g.climb_tread_skew_rate * s.torso_spin;
  const Legs legs{g.climb_tread_hip + skew, g.climb_tread_knee, g.climb_tread_ankle};
  for (int side = 0; side < 2; ++side) PoseLegs(legs, legs, 0, side);
}

/// Returns the arms' turns per s that bring the torso back to its lean, from `error` rad beyond it:
/// the water resists turning arms, and the reaction turns the torso the other way.
float CharacterControl::RightingHz(const CharacterSense& s, float error) const {
  const CharacterGains& g = gains_;
  return std::clamp(-g.right_turn * error - g.right_rate * s.torso_spin, -g.right_max, g.right_max);
}

/// Returns the legs between treading and the stroke's mean, while the arms right the torso.
CharacterControl::Legs CharacterControl::ReadyLegs(const Legs& tread, float error,
                                                   float share) const {
  const CharacterGains& g = gains_;
  const float skew = std::clamp(g.ready_skew * error, -g.ready_skew_max, g.ready_skew_max);
  return {tread.hip + share * (g.hip_middle + skew - tread.hip),
          tread.knee + share * (g.knee_middle - tread.knee),
          tread.ankle + share * (g.ankle_middle - tread.ankle)};
}

void CharacterControl::Swim(const CharacterSense& s, float h) {
  const CharacterGains& g = gains_;
  // The drive is ramped, and the stroke with it: a sudden one turns the body over.
  memory_.speed += std::clamp(drive_ - memory_.speed, -g.swim_ramp * h, g.swim_ramp * h);
  const float share = std::clamp(memory_.speed, -1.0f, 1.0f), size = std::abs(share);
  const float driven = std::min(size / g.swim_full, 1.0f);
  // From an unfit lean a stroke turns the body over: then the arms first right the torso, beyond
  // the stroke's lean by as much as the stroke's beginning turns it back.
  const float off = s.torso + StrokeLean(share),
              lead = share < 0 ? -g.stroke_lead_back : g.stroke_lead;
  const float error = s.torso + g.tread_lean + driven * (off + lead - s.torso - g.tread_lean);
  if (memory_.phase != kStrokes && driven == 1) {
    if (std::abs(error) < g.stroke_from && std::abs(s.torso_spin) < g.stroke_calm)
      memory_.phase = kStrokes;
  } else if (memory_.phase == kStrokes &&
             (driven < 0.5f || (share < 0 ? -off : off) > g.stroke_to)) {
    memory_.phase = kTreads;
  } else if (memory_.phase != kStrokes && std::abs(error) > g.tread_turned) {
    memory_.phase = kRights;
  } else if (memory_.phase == kRights && std::abs(error) < g.tread_righted) {
    memory_.phase = kTreads;
  }
  const float to = memory_.phase == kStrokes ? 1.0f : 0.0f;
  memory_.to += std::clamp(to - memory_.to, -h / g.stroke_fade, h / g.stroke_fade);
  float& turned_over = memory_.from.y;
  const float over = memory_.phase == kRights ? 1.0f : 0.0f;
  turned_over += std::clamp(over - turned_over, -h / g.stroke_fade, h / g.stroke_fade);
  const float swims = memory_.to * driven, rights = (1 - memory_.to) * driven;
  // Drag goes with the square of the speed: the same stroke in reverse pushes the other way.
  const float turning = g.swim_slow_hz + size * (g.swim_hz - g.swim_slow_hz);
  // The arms also right a body that lies turned over at rest.
  const float turned = (1 - driven) * turned_over;
  const float rests = 1 - driven - turned, rights_all = rights + turned;
  // At rest, the arms sink to in front of and behind the torso.
  const float sinking = -g.arms_back * (memory_.phase_time - std::round(memory_.phase_time));
  const float hz = swims * (share < 0 ? -turning : turning) + rights_all * RightingHz(s, error) +
                   rests * sinking;
  float& ready = memory_.from.x;
  ready += std::clamp(driven - ready, -h / g.ready_time, h / g.ready_time);
  TurnOn(&memory_.phase_time, hz * h);
  TurnOn(&memory_.step, g.tread_hz * h);
  const float skew = rests * g.tread_arms_skew * std::clamp(error, -1.0f, 1.0f);
  // Both arms beat at once, fast down and slowly up, which lifts the body; the arm on the side of
  // the torso's fall beats more, which brings the torso back.
  const float scull = g.tread_scull * Scull(memory_.step, g.tread_haste);
  const float tilt = g.tread_balance * error + g.tread_balance_rate * s.torso_spin;
  const float strength = g.swim_shoulder + rights_all * (g.right_shoulder - g.swim_shoulder) +
                         rests * (g.tread_shoulder - g.swim_shoulder);
  const float bend = g.tread_elbow_sine * Scull(memory_.step + g.tread_elbow_phase, g.tread_haste);
  for (int side = 0; side < 2; ++side) {
    const float half = 0.5f * static_cast<float>(side);
    const float turn = memory_.phase_time - 0.25f + half;
    // From overhead down in front of the body; at rest, one in front and one behind.
    const float ahead = side == 0 ? 1.0f : -1.0f;
    const float beat = scull * std::clamp(1 - ahead * tilt, 0.0f, 2.0f);
    const float apart = 0.5f * b2_pi + rests * (g.tread_arms + beat - 0.5f * b2_pi);
    Pose(Shoulder(side),
         ahead * apart - 2 * b2_pi * memory_.phase_time + skew +
             swims * g.shoulder_sine * Sine(turn + g.shoulder_phase),
         strength, -2 * b2_pi * hz);
    const float elbow = g.elbow_middle + g.elbow_sine * Sine(turn + g.elbow_phase);
    const float rest = rests * ((side == 0 ? g.tread_elbow : g.tread_elbow_behind) + bend);
    Pose(Elbow(side), rest + swims * (elbow - rest), g.swim_elbow);
    const Legs tread = ReadyLegs(TreadLegs(s, memory_.step + half), error, ready);
    PoseLegs(tread, BeatLegs(s, turn, share), swims, side);
  }
  // Keeps the face out of the water.
  Pose(kNeck, std::clamp(-s.torso, -0.5f, 0.5f), g.neck_stiffness);
}

}  // namespace seam
