/// CharacterControl: swimming, a crawl of the arms and a flutter of the legs. What moves the body
/// is the water's drag on straight arms that sweep and folded ones that come back, nothing else.

#include <algorithm>
#include <cmath>

#include "common/scene/water.h"
#include "common/stages/character/character_control.h"

namespace seam {

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

void CharacterControl::Swim(const CharacterSense& s, float h) {
  memory_.phase_time += h;
  const float turns = kStrokeHz * memory_.phase_time;
  const float lean = -kSwimLean * std::max(drive_, 0.0f) - 0.2f * std::max(-drive_, 0.0f);
  const bool backward = drive_ < -0.1f;
  for (int side = 0; side < 2; ++side) {
    float phase = turns + 0.5f * static_cast<float>(side);
    phase -= std::floor(phase);
    // From overhead to the hip and back; straight on the way that is to push.
    const bool down = phase < 0.5f;
    const float part = down ? 2 * phase : 2 - 2 * phase;
    const float shoulder = kStrokeFrom + part * (kStrokeTo - kStrokeFrom);
    const bool push = down != backward;
    Pose(Shoulder(side), shoulder, kStrokeStiffness);
    Pose(Elbow(side), push ? 0.1f : kFolded, kStrokeStiffness);
    const float beat = kKicks * turns + 0.5f * static_cast<float>(side);
    const float kick = kKick * std::sin(2 * b2_pi * (beat - std::floor(beat)));
    const float steer = std::clamp(kSwimSteer * (s.torso - lean), -0.6f, 0.9f);
    Pose(Hip(side), 0.1f + kick + steer, kStrokeStiffness);
    Pose(Knee(side), -0.25f, 0.3f * kStrokeStiffness);
    Pose(Ankle(side), -0.7f, 0.3f * kStrokeStiffness);
  }
  // The face out of the water.
  Pose(kNeck, std::clamp(-s.torso, -0.5f, 0.5f), kNeckStiffness);
}

}  // namespace seam
