#include "common/stages/character/character_control.h"

#include <algorithm>
#include <cmath>

#include "common/scene/character.h"
#include "common/scene/water.h"
#include "common/stages/character/character_gains.h"

namespace seam {
namespace {

/// A player's lift below this (fully down) makes a character limp.
constexpr float kLimpLift = -0.9f;

/// s at the start of limpness without muscle tone, which would keep a standing character on its
/// feet.
constexpr float kBuckle = 0.5f;

/// m of water over the ground, for 1.8 m: above the first it swims, below the second it stands up.
constexpr float kSwimDepth = 0.75f, kWadeDepth = 0.3f;

}  // namespace

void CharacterMemory::Save(std::vector<float>* memory) const {
  memory->insert(memory->end(),
                 {static_cast<float>(mode), time, static_cast<float>(stance), step, from.x, from.y,
                  to, edge.x, edge.y, speed, static_cast<float>(phase), phase_time, hold[0],
                  hold[1], load[0], load[1], limp});
}

void CharacterMemory::Load(StageMemory* memory) {
  mode = static_cast<CharacterMode>(memory->NextInt(0, static_cast<int>(CharacterMode::kClimb)));
  time = memory->Next();
  stance = memory->NextInt(0, 1);
  step = memory->Next();
  from.x = memory->Next();
  from.y = memory->Next();
  to = memory->Next();
  edge.x = memory->Next();
  edge.y = memory->Next();
  speed = memory->Next();
  phase = memory->NextInt(0, kPhaseMost);
  phase_time = memory->Next();
  for (float& each : hold) each = memory->Next();
  for (float& each : load) each = memory->Next();
  limp = memory->Next();
}

CharacterControl::CharacterControl(const Character& character, const StageWorld& world)
    : character_(character),
      world_(world),
      gains_(character.gains ? *character.gains : CharacterGains{}),
      limbs_(character, world),
      hands_(character, world) {
  gravity_ = std::max(1.0f, -world.scene.gravity.y());
}

void CharacterControl::SetInput(const Input& input) {
  drive_ = character_.facing * static_cast<float>(std::max<int>(input.drive, -127)) / 127.0f;
  lift_ = static_cast<float>(std::max<int>(input.lift, -127)) / 127.0f;
}

void CharacterControl::Enter(CharacterMode mode) {
  memory_.mode = mode;
  memory_.time = 0;
  memory_.phase = 0;
  memory_.phase_time = 0;
}

void CharacterControl::Struck(float impulse) {
  if (!limbs_.whole()) return;
  const float speed = impulse / limbs_.Sense().mass;
  if (speed < gains_.limp_speed) return;
  memory_.limp = std::max(memory_.limp, std::min(gains_.limp_time * speed, gains_.limp_max));
}

void CharacterControl::GoLimp(float seconds) {
  memory_.limp = seconds < 0 ? 0 : std::max(memory_.limp, seconds);
}

void CharacterControl::Act(float h) {
  if (!limbs_.dynamic()) return;
  if (!limbs_.whole()) {
    if (memory_.mode != CharacterMode::kLimp) Enter(CharacterMode::kLimp);
    limbs_.SlackenAll();
    return;
  }
  const CharacterSense s = limbs_.Sense();
  unit_ = s.mass * 10 * character_.height;
  memory_.time += h;
  memory_.limp = std::max(0.0f, memory_.limp - h);
  const bool limp = memory_.limp > 0 || lift_ < kLimpLift;
  if (limp != (memory_.mode == CharacterMode::kLimp)) {
    Enter(limp ? CharacterMode::kLimp : CharacterMode::kFall);
  }
  if (!limp) Choose(s, h);
  switch (memory_.mode) {
    case CharacterMode::kStand: Stand(s); break;
    case CharacterMode::kStep: StepOn(s, h); break;
    case CharacterMode::kJump: Jump(s); break;
    case CharacterMode::kAir: Air(s); break;
    case CharacterMode::kFall: Fall(s); break;
    case CharacterMode::kRise: Rise(s, h); break;
    case CharacterMode::kSwim: Swim(s, h); break;
    case CharacterMode::kClimb: Climb(s, h); break;
    case CharacterMode::kLimp: limbs_.SlackenAll(memory_.time < kBuckle ? 0.0f : 1.0f); break;
  }
}

/// Switches to the modes that circumstances force; each mode ends itself in its own function.
void CharacterControl::Choose(const CharacterSense& s, float h) {
  if (!world_.scene.waters.empty()) {
    const float depth = ChestDepth(s) / limbs_.scale();
    if (memory_.mode == CharacterMode::kClimb) return;
    const bool swims = memory_.mode == CharacterMode::kSwim;
    // In water shallow enough to stand in, a character does not swim: at a beach it gets up and
    // walks.
    const float over = WaterOverGround(s) / limbs_.scale();
    if (!swims && depth > gains_.swim_from && over > kSwimDepth) {
      Enter(CharacterMode::kSwim);
      memory_.speed = memory_.to = memory_.step = 0;
      memory_.from.SetZero();
    }
    const bool touches = s.legs[0].down || s.legs[1].down || s.lying;
    const bool stands = over < kWadeDepth || (touches && depth < gains_.swim_to);
    if (swims && stands)
      Enter(std::abs(s.torso) < 0.5f * gains_.tilt_max ? CharacterMode::kStand
                                                       : CharacterMode::kFall);
    const bool on = memory_.mode == CharacterMode::kSwim && character_.grip && drive_ > 0.3f;
    if (on && memory_.time > 0.5f && LedgeAhead(s).found) Enter(CharacterMode::kClimb);
    if (memory_.mode == CharacterMode::kSwim || memory_.mode == CharacterMode::kClimb) return;
  }
  const bool upright_mode =
      memory_.mode == CharacterMode::kStand || memory_.mode == CharacterMode::kStep ||
      memory_.mode == CharacterMode::kJump || memory_.mode == CharacterMode::kAir;
  if (!upright_mode) return;
  const float low = std::min(s.legs[0].ankle.y, s.legs[1].ankle.y) - limbs_.shape().ankle;
  const bool sunk =
      s.hip.y - low < gains_.sunk * limbs_.shape().hip && memory_.mode != CharacterMode::kAir;
  if (std::abs(s.torso) > gains_.tilt_max || sunk) {
    Enter(CharacterMode::kFall);
    return;
  }
  const bool walks = memory_.mode == CharacterMode::kStand || memory_.mode == CharacterMode::kStep;
  if (!walks) return;
  const bool down = s.legs[0].down || s.legs[1].down;
  memory_.phase_time = down ? 0 : memory_.phase_time + h;
  if (memory_.phase_time > gains_.lost_ground) {
    Enter(CharacterMode::kAir);
  } else if (lift_ > 0.5f && down && memory_.time > gains_.jump_rest) {
    const bool running = memory_.mode == CharacterMode::kStep;
    // Jumps from a run only with the foot below the body: otherwise the push would turn the body.
    const LegSense& stance = s.legs[memory_.stance];
    const float over = s.centre.x - stance.ankle.x;
    const bool below =
        over > -gains_.jump_behind * limbs_.scale() && over < gains_.jump_before * limbs_.scale();
    if (running && (!below || !stance.down)) return;
    Enter(CharacterMode::kJump);
    memory_.phase = running ? 2 : 0;  // no time to crouch while running
  }
}

float CharacterControl::Omega(const CharacterSense& s, float ground_y) const {
  const float height = std::max(0.3f * limbs_.shape().hip, s.centre.y - ground_y);
  return std::sqrt(gravity_ / height);
}

void CharacterControl::Pose(CharacterJoint joint, float angle, float strength, float spin,
                            float rate) {
  const float stiffness = strength * unit_;
  limbs_.Servo(joint, angle, spin, stiffness, stiffness / rate);
}

}  // namespace seam
