#include "common/sync/show/visual_offset.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/base/trig.h"

namespace seam {
namespace {

/// Speed limit of the return, m/s: kGlideMin, or kGlideShare of the body's own speed if that is
/// more.
constexpr float kGlideMin = 4.0f;
constexpr float kGlideShare = 0.35f;
constexpr float kSpinCap = 6.0f;  // rad/s
/// Limit for gentle mechanisms, m/s: 3.3 cm per tick, which leaves room for the motion of limbs.
constexpr float kGentle = 2;
/// An offset beyond this is dropped, and the view jumps: a glide would show wrong poses for
/// seconds. m
constexpr float kGiveUp = 15.0f;
/// Offsets below these count as zero: m (rad) and m/s (rad/s).
constexpr float kOver = 1e-5f, kOverSpeed = 1e-4f;

/// Advances exactly one step of a critically damped spring of that rate, 1/s, towards zero.
template <typename T>
void Return(float dt, float rate, T* offset, T* velocity) {
  const float decay = std::exp(-rate * dt);
  const T slope = *velocity + rate * *offset;
  *offset = (*offset + slope * dt) * decay;
  *velocity = (*velocity - slope * (rate * dt)) * decay;
}

float GlideMax(float speed) { return std::max(kGlideMin, kGlideShare * speed); }

Vec2 Crossed(float spin, const Vec2& arm) { return {-spin * arm.y(), spin * arm.x()}; }

/// A mechanism's offsets, split into one rigid motion and the remainder of each body.
struct Split {
  VisualOffset common;             // shift of the centre of mass, and turn about it
  Vec2 middle{0, 0};               // the simulated centre of mass
  std::vector<Vec2> arms;          // from it to the bodies' centres
  std::vector<VisualOffset> rest;  // of the bodies' centres
};

Split SplitOffsets(const std::vector<OffsetBody>& bodies) {
  Split split;
  float mass = 0;
  std::vector<Vec2> velocities;
  for (const OffsetBody& b : bodies) {
    const VisualOffset& o = *b.offset;
    const Vec2 arm = Turned(b.mass.centre, b.pose.angle);
    const Vec2 shown = Turned(b.mass.centre, b.pose.angle + o.angle);
    split.arms.push_back(b.pose.position + arm);
    VisualOffset rest = o;
    rest.position += shown - arm;
    split.rest.push_back(rest);
    mass += b.mass.mass;
    split.middle += b.mass.mass * split.arms.back();
    split.common.position += b.mass.mass * rest.position;
    split.common.velocity += b.mass.mass * rest.velocity;
  }
  split.middle /= mass;
  split.common.position /= mass;
  split.common.velocity /= mass;
  // Finds the turn nearest to all offsets, by least squares.
  float sine = 0, cosine = 0, moment = 0, inertia = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const MassPoint& m = bodies[i].mass;
    VisualOffset& rest = split.rest[i];
    rest.position -= split.common.position;
    rest.velocity -= split.common.velocity;
    Vec2& arm = split.arms[i];
    arm -= split.middle;
    const Vec2 shown = arm + rest.position;
    sine += m.mass * Cross(arm, shown) + m.inertia * Sin(rest.angle);
    cosine += m.mass * arm.dot(shown) + m.inertia * Cos(rest.angle);
    moment += m.mass * Cross(shown, rest.velocity) + m.inertia * rest.spin;
    inertia += m.mass * shown.squaredNorm() + m.inertia;
  }
  split.common.angle = std::atan2(sine, cosine);
  split.common.spin = inertia > 0 ? moment / inertia : 0;
  const Rotation<float> turn(split.common.angle);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    VisualOffset& rest = split.rest[i];
    const Vec2 shown = split.arms[i] + rest.position;
    rest.position = shown - turn(split.arms[i]);
    rest.velocity -= Crossed(split.common.spin, shown);
    rest.angle = WrapAngle(rest.angle - split.common.angle);
    rest.spin -= split.common.spin;
  }
  return split;
}

/// One step of an offset's return; `share` of it is taken, to keep within the limits.
struct Step {
  VisualOffset from, to;
  float share = 1;

  Step(float dt, float rate, const VisualOffset& offset) : from(offset), to(offset) {
    Return(dt, rate, &to.position, &to.velocity);
    Return(dt, rate, &to.angle, &to.spin);
  }
  void Limit(float size, float size_max) {
    if (size > size_max) share = std::min(share, size_max / size);
  }
  VisualOffset Taken(float dt) const {
    if (share >= 1) return to;
    VisualOffset taken;
    const Vec2 shift = share * (to.position - from.position);
    const float turn = share * (to.angle - from.angle);
    taken.position = from.position + shift;
    taken.velocity = shift / dt;
    taken.angle = from.angle + turn;
    taken.spin = turn / dt;
    return taken;
  }
};

void ReturnCommon(float dt, float rate, float glide, float reach, VisualOffset* common) {
  VisualOffset shift = *common, turn = *common;
  shift.angle = shift.spin = 0;
  turn.position.setZero();
  turn.velocity.setZero();
  Step shifting(dt, rate, shift), turning(dt, rate, turn);
  shifting.Limit((shifting.to.position - shift.position).norm(), glide * dt);
  const float angle = std::fabs(turning.to.angle - turn.angle);
  turning.Limit(angle, kSpinCap * dt);
  turning.Limit(angle * reach, glide * dt);
  shift = shifting.Taken(dt);
  turn = turning.Taken(dt);
  *common = {shift.position, shift.velocity, turn.angle, turn.spin};
}

/// Uses one share for all bodies, so that none runs ahead of its neighbours.
void ReturnRest(float dt, float rate, float glide, std::vector<VisualOffset>* rest) {
  std::vector<Step> steps;
  float share = 1;
  for (const VisualOffset& offset : *rest) {
    Step step(dt, rate, offset);
    step.Limit((step.to.position - offset.position).norm(), glide * dt);
    step.Limit(std::fabs(step.to.angle - offset.angle), kSpinCap * dt);
    share = std::min(share, step.share);
    steps.push_back(step);
  }
  for (std::size_t i = 0; i < steps.size(); ++i) {
    steps[i].share = share;
    (*rest)[i] = steps[i].Taken(dt);
  }
}

/// Returns both parts of a mechanism's offsets.
void ReturnSplit(float dt, float rate, float glide, float reach, Split* split) {
  ReturnCommon(dt, rate, glide, reach, &split->common);
  ReturnRest(dt, rate, glide, &split->rest);
}

/// Returns the offset of a body's centre of mass.
Vec2 CentreOffset(const Split& split, std::size_t i) {
  const Rotation<float> turn(split.common.angle);
  return split.common.position + turn(split.arms[i]) - split.arms[i] + split.rest[i].position;
}

/// Returns the longest way of any body's centre in this step, m.
float FurthestWay(const Split& before, const Split& after) {
  float furthest = 0;
  for (std::size_t i = 0; i < before.rest.size(); ++i) {
    furthest = std::max(furthest, (CentreOffset(after, i) - CentreOffset(before, i)).norm());
  }
  return furthest;
}

/// Keeps every body within kGentle: a foot is moved by the shift, the turn and its remainder, and
/// each within the limit would be three times the limit together.
void ReturnGently(float dt, float rate, float reach, Split* split) {
  const Split before = *split;
  ReturnSplit(dt, rate, kGentle, reach, split);
  const float furthest = FurthestWay(before, *split);
  if (furthest <= kGentle * dt) return;
  *split = before;
  ReturnSplit(dt, rate, kGentle * (kGentle * dt / furthest), reach, split);
}

bool Over(const VisualOffset& o) {
  return o.position.norm() < kOver && o.velocity.norm() < kOverSpeed &&
         std::fabs(o.angle) < kOver && std::fabs(o.spin) < kOverSpeed;
}

}  // namespace

void ReturnAlone(float dt, float rate, float speed, VisualOffset* offset) {
  VisualOffset& o = *offset;
  if (o.zero()) return;  // true of nearly all bodies in every tick
  if (o.position.norm() > kGiveUp) o = VisualOffset{};
  const Vec2 was = o.position;
  Return(dt, rate, &o.position, &o.velocity);
  const Vec2 move = o.position - was;
  const float most = GlideMax(speed) * dt;
  if (move.norm() > most) {
    const Vec2 capped = move * (most / move.norm());
    o.position = was + capped;
    o.velocity = capped / dt;
  }
  if (o.position.norm() < kOver && o.velocity.norm() < kOverSpeed) {
    o.position.setZero();
    o.velocity.setZero();
  }
  const float angle_was = o.angle;
  Return(dt, rate, &o.angle, &o.spin);
  if (std::fabs(o.angle - angle_was) > kSpinCap * dt) {
    o.spin = std::copysign(kSpinCap, o.angle - angle_was);
    o.angle = angle_was + o.spin * dt;
  }
  if (std::fabs(o.angle) < kOver && std::fabs(o.spin) < kOverSpeed) o.angle = o.spin = 0;
}

void ReturnTogether(float dt, float rate, const std::vector<OffsetBody>& bodies, bool gentle) {
  Split split = SplitOffsets(bodies);
  if (split.common.position.norm() > kGiveUp) {
    for (const OffsetBody& b : bodies) *b.offset = VisualOffset{};
    return;
  }
  Vec2 momentum(0, 0);
  float mass = 0, reach = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    momentum += bodies[i].mass.mass * bodies[i].pose.velocity;
    mass += bodies[i].mass.mass;
    reach = std::max(reach, split.arms[i].norm());
  }
  const float glide = GlideMax((momentum / mass).norm());
  if (gentle) {
    ReturnGently(dt, rate, reach, &split);
  } else {
    ReturnSplit(dt, rate, glide, reach, &split);
  }
  const Rotation<float> turn(split.common.angle);
  bool over = true;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const OffsetBody& b = bodies[i];
    const VisualOffset &common = split.common, &rest = split.rest[i];
    VisualOffset& o = *b.offset;
    const Vec2 turned = turn(split.arms[i]);
    const Vec2 centre = common.position + turned - split.arms[i] + rest.position;
    o.angle = WrapAngle(common.angle + rest.angle);
    o.spin = common.spin + rest.spin;
    const Vec2 shown = Turned(b.mass.centre, b.pose.angle + o.angle);
    o.position = centre - (shown - Turned(b.mass.centre, b.pose.angle));
    o.velocity =
        common.velocity + Crossed(common.spin, Vec2(turned + rest.position)) + rest.velocity;
    over = over && Over(o);
  }
  if (!over) return;
  for (const OffsetBody& b : bodies) *b.offset = VisualOffset{};
}

}  // namespace seam
