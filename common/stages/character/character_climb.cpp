/// CharacterControl: out of the water over a ledge, hand over hand. The hands hold the ledge by
/// grips, which are edits; what lifts the body is torque in shoulders and elbows.
///
///              o   P: the edge        1  reach P, or the wall's face as high as it goes; hold
///             /|\__________           2  lead the shoulders up and over P
///   ~~~~~~~~~~ |~|  ledge             3  on the ledge, each hand that is behind reaches on
///             / \|                       until the legs are over, too

#include <algorithm>
#include <cmath>

#include "common/stages/character/character_control.h"

namespace seam {

/// Something solid before the chest, with a top that hands can reach. In the own frame.
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

/// Both arms' joints for a fingertip `way` from the shoulder; elbows bend forwards only.
void CharacterControl::ReachWith(const CharacterSense& s, int side, b2Vec2 way) {
  const float a = limbs_.shape().upper_arm, b = limbs_.shape().lower_arm;
  const float distance = std::clamp(way.Length(), 0.35f * (a + b), 0.99f * (a + b));
  const float to = std::atan2(way.x, -way.y);
  const float at_shoulder = std::acos((a * a + distance * distance - b * b) / (2 * a * distance));
  const float at_elbow = std::acos((a * a + b * b - distance * distance) / (2 * a * b));
  Pose(Shoulder(side), to - at_shoulder - s.torso, gains_.climb_shoulder);
  Pose(Elbow(side), b2_pi - at_elbow, gains_.climb_elbow);
}

void CharacterControl::LetGo() {
  for (float& hold : memory_.hold) hold = std::min(hold, 0.0f);
}

void CharacterControl::RestHands(float h) {
  for (int side = 0; side < 2; ++side) {
    float& hold = memory_.hold[side];
    if (hold < 0) hold = std::min(hold + h, 0.0f);
    if (memory_.mode != CharacterMode::kClimb) hold = std::min(hold, 0.0f);
    if (hold > 0 && hands_.holds(side) && hands_.TooMuch(side)) hold = -gains_.climb_rest;
  }
}

void CharacterControl::Climb(const CharacterSense& s, float h) {
  const float m = limbs_.scale();
  const CharacterShape& shape = limbs_.shape();
  const float reach = shape.upper_arm + shape.lower_arm;
  // The edge is remembered in `from`: over it, there is no wall ahead to be seen any more.
  if (memory_.phase == 0) {
    const Ledge ledge = LedgeAhead(s);
    if (ledge.found) memory_.from = ledge.edge;
    if (!ledge.found && memory_.time == 0) return Enter(CharacterMode::kSwim);
  }
  const b2Vec2 edge = memory_.from;
  const bool over = s.hip.x > edge.x + gains_.climb_over * shape.thigh;
  if (over || drive_ < 0.1f || memory_.time > gains_.climb_max) {
    LetGo();
    Enter(over ? CharacterMode::kFall : CharacterMode::kSwim);
    return;
  }
  memory_.phase_time += h;
  const b2Vec2 shoulder = limbs_.Shoulder();
  const bool above = shoulder.y > edge.y + gains_.climb_above * m;
  if (above) memory_.phase = 1;
  // Up before the wall, then forwards over the edge.
  const b2Vec2 up(edge.x - gains_.climb_off * m, edge.y + (gains_.climb_above + 0.15f) * m);
  const b2Vec2 on(std::max(shoulder.x, edge.x) + 0.35f * m, edge.y + gains_.climb_chest * m);
  const b2Vec2 to = memory_.phase == 0 ? up : on;
  b2Vec2 way = to - shoulder;
  const float most = gains_.climb_lead * m;
  if (way.Length() > most) way *= most / way.Length();
  const bool holds[2] = {hands_.holds(0), hands_.holds(1)};
  for (int side = 0; side < 2; ++side) {
    if (!hands_.has(side)) continue;
    const b2Vec2 tip = limbs_.Own(hands_.Tip(side));
    const bool other = holds[1 - side];
    if (holds[side]) {
      const bool low = memory_.phase == 0 && tip.y < edge.y - 0.05f * m;
      const bool passed = low ? tip.y < shoulder.y + gains_.climb_again * m
                              : memory_.phase == 1 && tip.x < shoulder.x - 0.05f * m;
      // One hand at a time.
      if (passed && other && memory_.hold[1 - side] > 0) {
        memory_.hold[side] = -gains_.climb_rest;
      }
      ReachWith(s, side, tip - (shoulder + way));
      continue;
    }
    b2Vec2 target(edge.x + (0.05f + 0.05f * static_cast<float>(side)) * m, edge.y);
    if (memory_.phase == 1) target.x = std::max(target.x, shoulder.x + 0.8f * reach);
    b2Vec2 there = target - shoulder;
    if (memory_.phase == 0 && there.Length() > reach) {
      const float across = std::min(edge.x - shoulder.x, 0.9f * reach);
      there.Set(across, std::sqrt(reach * reach - across * across));
    }
    if (memory_.hold[side] == 0) memory_.hold[side] = 1;
    ReachWith(s, side, there);
  }
  const float beat = gains_.climb_kick_hz * memory_.phase_time;
  for (int side = 0; side < 2; ++side) {
    const float turn = 2 * b2_pi * (beat + 0.5f * static_cast<float>(side));
    const float kick = gains_.climb_kick * std::sin(turn);
    Pose(Hip(side), (memory_.phase == 0 ? gains_.climb_hip : gains_.climb_hip_over) + kick,
         gains_.swim_hip);
    Pose(Knee(side), gains_.climb_knee, gains_.swim_knee);
    Pose(Ankle(side), -0.5f, gains_.swim_ankle);
  }
  Pose(kNeck, 0, gains_.neck_stiffness);
}

}  // namespace seam
