/// CharacterControl: stepping. The pendulum gives the desired foothold, the ground the possible
/// ones, and the step's duration makes up for the difference.

#include <algorithm>
#include <cmath>

#include "common/stages/character/character_control.h"
#include "common/stages/character/character_gains.h"

namespace seam {
namespace {

/// m between samples of the ground ahead, and the rise between two samples that counts as a stair.
constexpr float kScan = 0.05f, kRiser = 0.06f;
/// Distance from the desired foothold within which a flat one is searched, m, and samples per side.
constexpr float kAsideMax = 0.32f;
constexpr int kAsides = 8;
/// Step durations after which a foot that has not passed an edge goes down anyway.
constexpr float kHoverMax = 1.5f;
/// A height that never limits, m.
constexpr float kNoHeight = -1e6f;

float Smooth(float t) {
  const float u = std::clamp(t, 0.0f, 1.0f);
  return u * u * (3 - 2 * u);
}

}  // namespace

/// Returns the gait changes near a stair.
CharacterControl::StairGait CharacterControl::Stairs() const {
  const CharacterGains& g = gains_;
  if (memory_.edge.x >= kNoEdge) return {g.run_speed_max, 1, 0, 0, 0, false};
  const float rise = memory_.edge.y + limbs_.shape().ankle - memory_.from.y;
  if (rise > 0)
    return {g.upstairs_speed, g.upstairs_time, g.upstairs_height,
            g.upstairs_ahead, g.upstairs_lean, false};
  return {g.downstairs_speed, g.downstairs_time, g.downstairs_height,
          g.downstairs_ahead, g.downstairs_lean, true};
}

float CharacterControl::StepTime() const {
  return gains_.step_time * Stairs().time * std::sqrt(limbs_.scale());
}

void CharacterControl::BeginStep(const CharacterSense& s, int stance) {
  memory_.stance = stance;
  memory_.step = 0;
  memory_.from = s.legs[1 - stance].ankle;
  memory_.to = memory_.from.x;
  memory_.edge = EdgeAhead(s, memory_.from.x + limbs_.shape().toe);
}

/// Returns the edge, on its far side, of the first stair up or down from `from_x` within a foot's
/// reach; kNoEdge if none.
b2Vec2 CharacterControl::EdgeAhead(const CharacterSense& s, float from_x) const {
  const CharacterShape& shape = limbs_.shape();
  const float scale = limbs_.scale(), ground_y = s.legs[memory_.stance].ankle.y - shape.ankle;
  const auto height_at = [&](float x) {
    const GroundPoint below =
        limbs_.GroundBelow(b2Vec2(x, ground_y + 0.5f * shape.hip), 1.2f * shape.hip);
    return below.found ? below.point.y - ground_y : -shape.hip;
  };
  const float end = s.hip.x + gains_.reach_max * scale + shape.toe;
  // No leg is further from the hip than this; a saved room may say so all the same.
  float x = std::max(from_x, s.hip.x - 2 * shape.hip), height = height_at(x);
  while (x < end) {
    float next = x + kScan * scale, next_height = height_at(next);
    if (std::abs(next_height - height) < kRiser * scale) {
      x = next;
      height = next_height;
      continue;
    }
    for (int half = 0; half < 3; ++half) {
      const float middle = (x + next) / 2, there = height_at(middle);
      (std::abs(there - height) < kRiser * scale ? x : next) = middle;
    }
    return b2Vec2(next, ground_y + next_height);
  }
  return b2Vec2(kNoEdge, 0);
}

/// Returns the ankle's x, m, from which the pendulum continues at the desired speed.
float CharacterControl::DesiredFoothold(const CharacterSense& s, float support_x) const {
  const CharacterShape& shape = limbs_.shape();
  const LegSense& stance = s.legs[memory_.stance];
  const float omega = Omega(s, stance.ankle.y - shape.ankle);
  const float left = std::max(StepTime() - memory_.step, 0.0f);
  // The divergent component at the end of the step, if the pressure stays where it is.
  const float now = s.centre.x + (s.velocity.x - stance.ground_velocity.x) / omega;
  const float then = support_x + (now - support_x) * std::exp(omega * left);
  const float hip_then = s.hip.x + left * s.velocity.x;
  return std::clamp(then - Ahead(omega), hip_then - gains_.reach_back * limbs_.scale(),
                    hip_then + gains_.reach_max * limbs_.scale());
}

/// Returns how far the divergent component must be ahead of the next foot's ankle, m.
float CharacterControl::Ahead(float omega) const {
  const CharacterShape& shape = limbs_.shape();
  return memory_.speed * StepTime() / (std::exp(omega * StepTime()) - 1) +
         (shape.toe - shape.heel) / 2 + Stairs().ahead * limbs_.scale();
}

/// Returns true if heel and toe, and `rims` beyond them, are on one face of the ground. Sets the
/// foothold in either case.
bool CharacterControl::FlatAt(const CharacterSense& s, float x, const Rims& rims,
                              Foothold* foothold) const {
  const CharacterShape& shape = limbs_.shape();
  const float ground_y = s.legs[memory_.stance].ankle.y - shape.ankle;
  const float from_y = ground_y + 0.5f * shape.hip, depth = 1.2f * shape.hip;
  const GroundPoint heel = limbs_.GroundBelow(b2Vec2(x - shape.heel - rims.heel, from_y), depth);
  const GroundPoint toe = limbs_.GroundBelow(b2Vec2(x + shape.toe + rims.toe, from_y), depth);
  const float heel_y = heel.found ? heel.point.y : ground_y;
  const float toe_y = toe.found ? toe.point.y : ground_y;
  const float length = shape.heel + shape.toe + rims.heel + rims.toe;
  // On one face, the slope between its two ends agrees with its normal.
  const bool flat = std::abs(toe_y - heel_y) < gains_.slope_max * length &&
                    (heel.normal - toe.normal).Length() < 0.3f &&
                    std::abs((toe_y - heel_y) * heel.normal.y + length * heel.normal.x) <
                        gains_.uneven * limbs_.scale();
  foothold->ankle.Set(x, std::max(heel_y, toe_y) + shape.ankle);
  foothold->slope = 0;
  if (!flat) return false;
  foothold->slope = std::atan2(toe_y - heel_y, length);
  foothold->ankle.y = heel_y + (toe_y - heel_y) * (shape.heel + rims.heel) / length + shape.ankle;
  return true;
}

/// Returns the next foothold: not across the edge of a stair, if there is room beside it.
CharacterControl::Foothold CharacterControl::NextFoothold(const CharacterSense& s,
                                                          float support_x) const {
  const float scale = limbs_.scale();
  float wished = DesiredFoothold(s, support_x);
  Foothold next;
  bool flat = FlatAt(s, wished, {0, 0}, &next);
  if (memory_.step > gains_.edge_commit * StepTime()) {
    Foothold chosen;
    const bool was_flat = FlatAt(s, memory_.to, {0, 0}, &chosen);
    if (std::abs(chosen.ankle.y - next.ankle.y) > kRiser * scale) {
      wished = memory_.to;
      next = chosen;
      flat = was_flat;
    }
  }
  if (flat) return next;
  const Foothold edge = next;
  // Downstairs the heel keeps clear of the riser behind, and toes may overhang the next edge.
  const bool down = Stairs().down;
  const Rims rims{(down ? gains_.downstairs_heel : gains_.edge_rim) * scale,
                  (down ? gains_.downstairs_toe : gains_.edge_rim) * scale};
  // The nearest one beside it, with a preference for the previous choice.
  float nearest = kAsideMax * scale;
  bool found = false;
  for (int i = -kAsides; i <= kAsides; ++i) {
    const float x = wished + static_cast<float>(i) / kAsides * kAsideMax * scale;
    float far = std::abs(x - wished);
    if (std::abs(x - memory_.to) > gains_.edge_keep * scale) far += gains_.edge_keep * scale;
    Foothold other;
    if (far >= nearest || !FlatAt(s, x, rims, &other)) continue;
    nearest = far;
    next = other;
    found = true;
  }
  return found ? next : edge;
}

/// Returns how much faster than usual the step must be for the divergent component to be in place
/// when the foot stands at `foothold_x`. After Khadiv and others, "Step Timing Adjustment: A Step
/// toward Generating Robust Gaits", 2016.
float CharacterControl::StepRate(const CharacterSense& s, float support_x, float foothold_x) const {
  const LegSense& stance = s.legs[memory_.stance];
  const float omega = Omega(s, stance.ankle.y - limbs_.shape().ankle);
  const float now = s.centre.x + (s.velocity.x - stance.ground_velocity.x) / omega - support_x;
  const float then = foothold_x + Ahead(omega) - support_x;
  const float left = StepTime() - memory_.step;
  if (left < 0.02f || std::abs(now) < 0.01f * limbs_.scale() || now * then <= 0) return 1;
  const float needed = std::log(std::max(1.02f, then / now)) / omega;
  return std::clamp(left / needed, gains_.step_rate_min, gains_.step_rate_max);
}

/// Returns the swinging foot's path at `time` s: up, over, and down to its foothold.
b2Vec2 CharacterControl::SwingAt(float time, const Foothold& to) const {
  const float whole = StepTime();
  const float t = time / whole;
  const b2Vec2 from = memory_.from;
  // Onto a stair, the foot goes up before it goes forward.
  const float toe = to.ankle.x + limbs_.shape().toe + gains_.edge_before * limbs_.scale();
  const float above = memory_.edge.y + limbs_.shape().ankle - from.y;
  const bool edge = toe > memory_.edge.x && above > 0.5f * kRiser * limbs_.scale();
  const bool stair =
      edge || (to.ankle.y > from.y + 0.05f * limbs_.scale() && std::abs(to.slope) < 0.05f);
  const float wait = stair ? gains_.stair_wait : 0;
  const float lifted = stair ? gains_.stair_lifted : gains_.lifted;
  const bool down = Stairs().down;
  const float arrive = down ? gains_.downstairs_arrive : gains_.arrive;
  const float x = from.x + (to.ankle.x - from.x) * Smooth((t - wait) / (arrive - wait));
  const float over = edge ? from.y + above : from.y;
  const float top = std::max({from.y, to.ankle.y, over}) +
                    (stair ? gains_.stair_clearance : gains_.clearance) * limbs_.scale();
  const float falls = down ? gains_.downstairs_falls : 0.5f;
  const float y = t < falls ? from.y + (top - from.y) * Smooth(t / lifted)
                            : top + (to.ankle.y - top) * Smooth((t - falls) / (1 - falls));
  const float late = t > 1 ? gains_.search * limbs_.scale() * (time - whole) : 0;
  return b2Vec2(x, y - late);
}

/// Returns the least height of the swinging ankle, m: above the stair that its heel has not left
/// yet. Depends on the foot's position and not on time: a late foot would come down on the edge,
/// and turn over it.
float CharacterControl::LeastHeight(const CharacterSense& s, int side, const Foothold& to) const {
  const CharacterShape& shape = limbs_.shape();
  const float scale = limbs_.scale();
  if (!Stairs().down || memory_.step > kHoverMax * StepTime()) return kNoHeight;
  const b2Vec2 heel = s.legs[side].ankle + b2Vec2(-shape.heel, 0.3f * shape.hip);
  const GroundPoint below = limbs_.GroundBelow(heel, 0.8f * shape.hip);
  const float on_it = below.point.y + shape.ankle;
  if (!below.found || to.ankle.y > on_it - kRiser * scale) return kNoHeight;
  return on_it + gains_.downstairs_hover * scale;
}

void CharacterControl::Swing(const CharacterSense& s, int side, const Foothold& to) {
  const float least = LeastHeight(s, side, to);
  b2Vec2 now = SwingAt(memory_.step, to);
  b2Vec2 then = SwingAt(memory_.step + kDerivativeStep, to);
  now.y = std::max(now.y, least);
  then.y = std::max(then.y, least);
  Reach(s, side, now, 1 / kDerivativeStep * (then - now), to.slope, gains_.swing_stiffness);
}

void CharacterControl::StepOn(const CharacterSense& s, float h) {
  const CharacterShape& shape = limbs_.shape();
  const float most = drive_ > 0 ? gains_.run_speed_max : gains_.speed_back;
  const StairGait stairs = Stairs();
  const float proposed =
      std::clamp(most * drive_, -stairs.speed, stairs.speed) * std::sqrt(limbs_.scale());
  memory_.speed +=
      std::clamp(proposed - memory_.speed, -gains_.speed_rate * h, gains_.speed_rate * h);
  const float whole = StepTime();
  const int swing = 1 - memory_.stance;
  if (s.legs[swing].down && memory_.step > 0.5f * whole) {
    BeginStep(s, swing);
    const LegSense& leg = s.legs[swing];
    const float relative = s.velocity.x - leg.ground_velocity.x;
    const float capture = s.centre.x + relative / Omega(s, leg.ankle.y - shape.ankle);
    const float low = std::min(leg.ankle.x, s.legs[1 - swing].ankle.x) - shape.heel;
    const float high = std::max(leg.ankle.x, s.legs[1 - swing].ankle.x) + shape.toe;
    const float in = 0.04f * limbs_.scale();
    if (std::abs(drive_) < 0.1f && std::abs(relative) < 0.6f && capture > low + in &&
        capture < high - in && s.legs[1 - swing].down) {
      Enter(CharacterMode::kStand);
      Stand(s);
      return;
    }
  }
  const LegSense& stance = s.legs[memory_.stance];
  const float ground_y = stance.ankle.y - shape.ankle;
  const float relative = s.velocity.x - stance.ground_velocity.x;
  const float middle = stance.ankle.x + (shape.toe - shape.heel) / 2;
  // A sole that tips over its toes at an edge is pressed down at its heel.
  const float tipped = stairs.down ? gains_.downstairs_flat * std::min(0.0f, stance.foot) : 0;
  const float pressure =
      Sole(s, memory_.stance, middle + gains_.step_pressure * (relative - memory_.speed)).x +
      tipped;
  const int swing_side = 1 - memory_.stance;
  const float support = middle + gains_.step_trust * (pressure - middle);
  const Foothold next = NextFoothold(s, support);
  memory_.to = next.ankle.x;
  memory_.step += h * StepRate(s, support, next.ankle.x);
  Swing(s, swing_side, next);
  // The hip keeps its height above the line from foot to foot.
  const b2Vec2 way = next.ankle - stance.ankle;
  const bool apart = std::abs(way.x) > 0.15f * shape.hip;
  const float rise = apart ? std::clamp(way.y / way.x, -gains_.slope_max, gains_.slope_max) : 0;
  const float along = apart ? std::clamp((s.hip.x - stance.ankle.x) / way.x, 0.0f, 1.0f) : 0;
  const float floor_y = ground_y + along * rise * way.x;
  const float floor_vy = stance.ground_velocity.y + rise * memory_.speed;
  const float height = gains_.step_height + stairs.height - gains_.crouch * std::abs(memory_.speed);
  const float lean = stairs.lean - gains_.lean * std::abs(memory_.speed);
  const float torso = TorsoTorque(s, lean) + limbs_.told(Hip(swing_side));
  Bear(s, memory_.stance, pressure, Lift(s, floor_y, height * shape.hip, floor_vy), torso);
  Arms(-0.8f * s.legs[0].thigh, -0.8f * s.legs[1].thigh, 0.7f);
}

}  // namespace seam
