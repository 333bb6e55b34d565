/// CharacterControl: climbing out of the water over a ledge, hand over hand. The hands hold the
/// ledge by grips, which are edits; torque in shoulders and elbows lifts the body.
///
///              o   P: the edge        1  reach P, or the wall's face as high as it goes; hold
///             /|\__________           2  move the shoulders up and over P
///   ~~~~~~~~~~ |~|  ledge             3  on the ledge, each hand that is behind reaches on
///             / \|                       until the legs are over, too
///
/// In front of the wall the legs hang: the hands would have to hold against their push. An arm
/// pulls less the more its hand bears. If the whole body lies still, for example on arms that prop
/// the chest up, the hands let go: the chest goes down, and they reach on.

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/stages/character/character_control.h"

namespace seam {
namespace {

/// Averaging time of a hand's load, s: an impact as short as an engine's step does not count.
constexpr float kGripMoment = 0.1f;

}  // namespace

/// Finds a solid obstacle in front of the chest, with a top within reach of the hands. In the own
/// frame.
CharacterControl::Ledge CharacterControl::LedgeAhead(const CharacterSense& s) const {
  const float m = limbs_.scale();
  const b2Vec2 chest = limbs_.Own(limbs_.body(kTorso)->GetPosition());
  const float level = chest.y + ChestDepth(s);
  Ledge ledge;
  for (const float y : {level + 0.03f * m, level - 0.15f * m}) {
    const GroundPoint wall =
        limbs_.Hit(b2Vec2(chest.x, y), b2Vec2(chest.x + gains_.climb_near * m, y));
    if (!wall.found || wall.normal.x > -0.6f) continue;
    const b2Vec2 above(wall.point.x + 0.06f * m, level + 0.9f * m);
    const GroundPoint top = limbs_.GroundBelow(above, m);
    if (!top.found || top.normal.y < 0.7f) continue;
    ledge.found = true;
    ledge.edge.Set(wall.point.x, top.point.y);
    return ledge;
  }
  return ledge;
}

/// Poses an arm's joints for a fingertip `way` from the shoulder; elbows bend forwards only.
void CharacterControl::ReachWith(const CharacterSense& s, int side, b2Vec2 way) {
  const float a = limbs_.shape().upper_arm, b = limbs_.shape().lower_arm;
  const float distance = std::clamp(way.Length(), 0.35f * (a + b), 0.99f * (a + b));
  const float to = std::atan2(way.x, -way.y);
  const float at_shoulder = std::acos((a * a + distance * distance - b * b) / (2 * a * distance));
  const float at_elbow = std::acos((a * a + b * b - distance * distance) / (2 * a * b));
  Pose(Shoulder(side), to - at_shoulder - s.torso, gains_.climb_shoulder);
  Pose(Elbow(side), b2_pi - at_elbow, gains_.climb_elbow);
}

/// Moves an arm that reaches up or on: behind the body, straight, as in a crawl, and down on the
/// ledge from above, since the wall is in front. Returns false once it is there.
bool CharacterControl::RaiseArm(const CharacterSense& s, int side, b2Vec2 tip, b2Vec2 edge) {
  const float m = limbs_.scale();
  const float arm = WrapAngle(s.torso + limbs_.angle(Shoulder(side)));  // 0: hanging; then forwards
  const b2Vec2 shoulder = limbs_.At(Shoulder(side));
  const float high = std::min(edge.y + 0.02f * m, shoulder.y + gains_.climb_raised * m);
  if (memory_.phase == 0 ? tip.y > high && arm > 0 : arm > gains_.climb_before) return false;
  const float to = arm > gains_.climb_raise ? b2_pi - 0.3f : arm - 0.8f;
  Pose(Shoulder(side), to - s.torso, gains_.climb_shoulder, -gains_.climb_raise_spin);
  Pose(Elbow(side), 0.3f, gains_.climb_elbow);
  return true;
}

/// Pulls the body by `force` N from the grip of one arm. Arms are treated as massless.
void CharacterControl::PullWith(int side, b2Vec2 force) {
  // Less than demanded if the hand bears nearly all that it can: otherwise it would let go.
  const float spare = 1 - memory_.load[side] / hands_.Strength(side);
  force *= std::clamp(spare / (1 - gains_.climb_ease), 0.0f, 1.0f);
  const b2Vec2 tip = limbs_.Own(hands_.Tip(side));
  const b2Vec2 shoulder = limbs_.At(Shoulder(side)), elbow = limbs_.At(Elbow(side));
  float turn = -b2Cross(tip - shoulder, force);
  float bend = -b2Cross(tip - elbow, force);
  if (memory_.phase == 1) {
    // The share that both joints can do: a limit on only one would turn the force's direction.
    const float share =
        std::min({1.0f, limbs_.bound(Shoulder(side)) / std::max(std::abs(turn), 1e-6f),
                  limbs_.bound(Elbow(side)) / std::max(std::abs(bend), 1e-6f)});
    turn *= share;
    bend *= share;
  }
  // Straight elbows stay straight under any pull: they bend only for a pull along the arm.
  b2Vec2 line = tip - shoulder;
  line.Normalize();
  const float along = memory_.phase == 0 ? force.Length() : std::max(b2Dot(force, line), 0.0f);
  const float lever = std::abs(b2Cross(tip - elbow, line)) + gains_.climb_lever * limbs_.scale();
  if (along > 0) bend = std::max(bend, gains_.climb_bend * along * lever);
  limbs_.Torque(Shoulder(side), turn);
  limbs_.Torque(Elbow(side), bend);
}

void CharacterControl::LetGo() {
  for (float& hold : memory_.hold) hold = std::min(hold, 0.0f);
}

/// Releases a hand that is overloaded, and lets it rest.
void CharacterControl::UpdateHandLoads(float h) {
  for (int side = 0; side < 2; ++side) {
    float& hold = memory_.hold[side];
    float& load = memory_.load[side];
    if (hold < 0) hold = std::min(hold + h, 0.0f);
    if (memory_.mode != CharacterMode::kClimb) hold = std::min(hold, 0.0f);
    load = hands_.holds(side) ? load + h / (h + kGripMoment) * (hands_.Force(side) - load) : 0;
    if (hands_.holds(side) && load > hands_.Strength(side)) hold = -gains_.climb_rest;
  }
}

/// Returns the force that all hands together must exert, N, with `tip` the mean grip. In front of
/// the wall they pull the centre of mass towards the tip, and sideways to that line as the torso's
/// lean demands; on the ledge they press it up and pull it on.
b2Vec2 CharacterControl::PullTo(const CharacterSense& s, b2Vec2 tip) const {
  const float m = limbs_.scale(), weight = s.mass * gravity_;
  const float slow = gains_.climb_damping / std::sqrt(m);
  if (memory_.phase == 1) {
    // The body leans over the edge, and falls on it.
    const float missing = (memory_.from.y - limbs_.At(kShoulderLeft).y) / m + gains_.climb_chest;
    // With the chest on the ledge, the hands only pull: pressing would lower the hips.
    const bool on = limbs_.At(kShoulderLeft).x > memory_.from.x + gains_.climb_on * m;
    if (on) return weight * b2Vec2(gains_.climb_forward, gains_.climb_slide);
    const float up = gains_.climb_lift + gains_.climb_press * missing - slow * s.velocity.y;
    return weight * b2Vec2(gains_.climb_forward, std::clamp(up, 0.0f, 1.5f));
  }
  b2Vec2 line = tip - s.centre;
  const float length = std::max(line.Normalize(), 0.3f * m);
  const float turn = gains_.climb_turn * TorsoTorque(s, -gains_.climb_lean) / length;
  const float pull = (gains_.climb_pull - slow * b2Dot(s.velocity, line)) * weight;
  const float across = std::clamp(turn, -0.5f * weight, 0.5f * weight);
  return std::max(pull, 0.0f) * line + across * b2Vec2(-line.y, line.x);
}

/// Returns true if a holding hand must let go and reach on: a hand on the wall once the shoulder is
/// level with it, a hand on the ledge once the body has passed it.
bool CharacterControl::MustReachOn(int side, b2Vec2 tip, b2Vec2 shoulder) const {
  const float m = limbs_.scale();
  // One hand at a time.
  if (!hands_.holds(1 - side) || memory_.hold[1 - side] <= 0) return false;
  if (memory_.phase == 1) {
    const float before = limbs_.Own(hands_.Tip(1 - side)).x - tip.x;
    return tip.x < shoulder.x - gains_.climb_behind * m || before > gains_.climb_stride * m;
  }
  return tip.y < memory_.from.y - 0.1f * m && tip.y < shoulder.y + gains_.climb_again * m;
}

/// Poses the legs in front of the wall.
void CharacterControl::Hang() {
  for (int side = 0; side < 2; ++side) {
    Pose(Hip(side), gains_.climb_hang_hip, gains_.climb_hang);
    Pose(Knee(side), gains_.climb_hang_knee, gains_.climb_hang);
    Pose(Ankle(side), -0.5f, gains_.swim_ankle);
  }
}

void CharacterControl::Climb(const CharacterSense& s, float h) {
  const float m = limbs_.scale();
  const float reach = limbs_.shape().upper_arm + limbs_.shape().lower_arm;
  const bool arms = limbs_.has(kShoulderLeft) && limbs_.has(kShoulderRight);
  // The edge is stored in `from`: once over it, no wall ahead is visible any more.
  const bool loose = !hands_.holds(0) && !hands_.holds(1);
  const b2Vec2 shoulder = limbs_.At(kShoulderLeft);
  // The chest is on the ledge: it stays there without hands, too.
  const bool on = memory_.phase == 1 && shoulder.x > memory_.from.x && shoulder.y > memory_.from.y;
  bool lost = loose && !on && std::abs(s.torso) > gains_.tilt_max;
  if (memory_.phase == 0 || (loose && !on)) {
    const Ledge ledge = LedgeAhead(s);
    if (ledge.found) memory_.from = ledge.edge;
    lost = lost || (loose && !ledge.found);
    if (loose) memory_.phase = 0;
  }
  const b2Vec2 edge = memory_.from;
  const bool over = s.hip.x > edge.x + gains_.climb_over * limbs_.shape().thigh;
  if (over || lost || !arms || drive_ < 0.1f || memory_.time > gains_.climb_max) {
    LetGo();
    Enter(over ? CharacterMode::kFall : CharacterMode::kSwim);
    return;
  }
  const float above = (shoulder.y - edge.y) / m;
  if (above > gains_.climb_above) memory_.phase = 1;
  if (above < gains_.climb_above - 0.1f && !on) memory_.phase = 0;
  // Hands that hold a motionless body without progress let go, and reach on.
  const bool still = on && s.velocity.LengthSquared() < gains_.climb_still * gains_.climb_still * m;
  memory_.phase_time = still ? memory_.phase_time + h : 0;
  if (memory_.phase_time > gains_.climb_stuck) {
    memory_.phase_time = 0;
    for (float& hold : memory_.hold) hold = -gains_.climb_flop;
  }
  const int holding = (hands_.holds(0) ? 1 : 0) + (hands_.holds(1) ? 1 : 0);
  for (int side = 0; side < 2; ++side) {
    if (!hands_.has(side)) continue;
    if (hands_.holds(side)) {
      const b2Vec2 tip = limbs_.Own(hands_.Tip(side));
      if (MustReachOn(side, tip, shoulder)) memory_.hold[side] = -gains_.climb_rest;
      b2Vec2 force = 1.0f / static_cast<float>(holding) * PullTo(s, tip);
      const float most = gains_.climb_grip * s.mass * gravity_;
      if (force.Length() > most) force *= most / force.Length();
      PullWith(side, force);
      continue;
    }
    b2Vec2 there = edge + b2Vec2((0.05f + 0.05f * static_cast<float>(side)) * m, 0) - shoulder;
    // On the ledge, pressing down a little.
    if (memory_.phase == 1)
      there.Set(std::max(there.x, gains_.climb_ahead * reach), there.y - 0.1f * m);
    if (memory_.phase == 0 && there.Length() > reach) {  // not yet the top: the wall's face
      const float across = std::clamp(edge.x - shoulder.x, 0.0f, 0.9f * reach);
      there.Set(across, std::sqrt(reach * reach - across * across));
    }
    const b2Vec2 tip = limbs_.Own(hands_.Tip(side));
    if (memory_.phase == 1 && memory_.hold[side] < -gains_.climb_rest) {  // the chest goes down
      ReachWith(s, side, b2Vec2(0.9f * reach, gains_.climb_lifted * m));
      continue;
    }
    const b2Vec2 missing = there + shoulder - tip;
    const bool lies = memory_.phase == 1 && tip.x > edge.x && tip.x > shoulder.x;
    const bool close = lies || missing.Length() < gains_.climb_close * m;
    if (memory_.hold[side] == 0 && (close || holding == 0)) memory_.hold[side] = 1;
    if (!close && RaiseArm(s, side, tip, edge)) continue;
    if (!close && memory_.phase == 0 && missing.y > 0.05f * m) there.x -= 0.1f * m;
    ReachWith(s, side, there);
  }
  // Bent hips bring the chest down on the ledge; straight legs follow.
  const bool bent = s.centre.x < edge.x + gains_.climb_flat * m && s.torso > -gains_.climb_down &&
                    s.hip.x > edge.x - 0.35f * m;
  if (memory_.phase == 0) {
    if (holding > 0) {
      Hang();
    } else {
      Tread(s);
    }
  } else {
    for (int side = 0; side < 2; ++side) {
      Pose(Hip(side), bent ? gains_.climb_hip : gains_.climb_straight, gains_.swim_hip);
      Pose(Knee(side), gains_.climb_knee, gains_.swim_knee);
      Pose(Ankle(side), -0.5f, gains_.swim_ankle);
    }
  }
  Pose(kNeck, 0, gains_.neck_stiffness);
}

}  // namespace seam
