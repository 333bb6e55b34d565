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
  const float turns = gains_.stroke_hz * memory_.phase_time;
  const float lean = -gains_.swim_lean * std::max(drive_, 0.0f) - 0.2f * std::max(-drive_, 0.0f);
  const bool backward = drive_ < -0.1f;
  for (int side = 0; side < 2; ++side) {
    float phase = turns + 0.5f * static_cast<float>(side);
    phase -= std::floor(phase);
    // From overhead to the hip and back; straight on the way that is to push.
    const bool down = phase < 0.5f;
    const float part = down ? 2 * phase : 2 - 2 * phase;
    const float shoulder = gains_.stroke_from + part * (gains_.stroke_to - gains_.stroke_from);
    const bool push = down != backward;
    Pose(Shoulder(side), shoulder, gains_.stroke_stiffness);
    Pose(Elbow(side), push ? 0.1f : gains_.folded, gains_.stroke_stiffness);
    const float beat = gains_.kicks * turns + 0.5f * static_cast<float>(side);
    const float kick = gains_.kick * std::sin(2 * b2_pi * (beat - std::floor(beat)));
    const float steer = std::clamp(gains_.swim_steer * (s.torso - lean), -0.6f, 0.9f);
    Pose(Hip(side), 0.1f + kick + steer, gains_.stroke_stiffness);
    Pose(Knee(side), -0.25f, 0.3f * gains_.stroke_stiffness);
    Pose(Ankle(side), -0.7f, 0.3f * gains_.stroke_stiffness);
  }
  // The face out of the water.
  Pose(kNeck, std::clamp(-s.torso, -0.5f, 0.5f), gains_.neck_stiffness);
}

}  // namespace seam
