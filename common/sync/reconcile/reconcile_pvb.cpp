/// pvb: projective velocity blending, after C. Murphy, "Believable Dead Reckoning for Networked
/// Games" (Game Engine Gems 2, 2011, chapter 18). When a message comes, our copy is at P0 with V0;
/// the authority's, extrapolated to that time, is at P0' with V0' and acceleration A'. With t since
/// then and T = t / (time of the blend), at most 1:
///   Vb = V0 + (V0' - V0) T                 P  = P0  + Vb  t + A' t^2 / 2
///   Q  = P + (P' - P) T                    P' = P0' + V0' t + A' t^2 / 2
/// Here the copy is not put at Q; its velocity leads there. An obstacle still stops the copy, which
/// ends the blend, and the next message starts from there.

#include <algorithm>
#include <cmath>

#include "common/sync/reconcile/reconcile.h"

namespace seam {
namespace {

/// Farther off than this, m, the copy is placed: a blend would move it at hundreds of m/s.
constexpr float kPvbPlaceBeyond = 8;
constexpr float kPvbMovedOnMax = 0.3f;  // s, for a copy that is placed
/// Shortest blend, s. The article blends over one interval; with 30 messages a second this corrects
/// half a metre at 15 m/s, and two peers' corrections build up against each other: a stack of ten
/// explodes. Longer follows later.
constexpr float kBlendMin = 0.3f;
/// A velocity this far from the one that the blend gave, m/s, means an impact: the rest of the
/// blend would push the other body. Less would count the springs of a car.
constexpr float kStruck = 1;
/// Share of the blend for bodies that touch those of another authority, where each peer corrects
/// towards the other's correction. More lets a stack rock; zero lets sliding bodies drift apart.
constexpr float kCoupledShare = 0.02f;
/// Above this spin the angle is not followed, rad/s: the wire lost its revolutions.
constexpr float kPvbSpinFollowed = 15;

/// Returns Q at `t`, for a position or an angle. `there`: P' at that time.
template <typename T>
T Blended(float t, float blend, const T& p0, const T& v0, const T& there0, const T& there_v0,
          const T& there) {
  const float share = std::min(1.0f, t / blend);
  const T vb = v0 + share * (there_v0 - v0);
  const T accelerated = there - there0 - t * there_v0;  // A' t^2 / 2, or its substitute
  const T p = p0 + t * vb + accelerated;
  return p + share * (there - p);
}

}  // namespace

Correction ReconcilePvb(const ReconcileInput& in) {
  Correction out;
  const BodyState d = Minus(Extrapolate(in.remote, std::min(in.dt, kPvbMovedOnMax)), in.local);
  if (d.position.norm() > kPvbPlaceBeyond) out.now = d;
  return out;
}

Correction PullPvb(const PullInput& in, PullMemory* memory) {
  const Vec2 expected = memory->before + memory->asked + in.drift.velocity;
  if (in.since_arrival == 0) {
    memory->share = 1;
  } else if ((in.local.velocity - expected).norm() > kStruck) {
    memory->share = 0;
  }
  if (memory->share <= 0) return Correction();
  const float blend = std::max(in.interval, kBlendMin);
  const float t = in.since_arrival;
  const auto path = [&](float at, const BodyState& there) {
    return Blended<Vec2>(at, blend, in.arrival.position, in.arrival.velocity,
                         in.target_then.position, in.target_then.velocity, there.position);
  };
  const auto turn = [&](float at, const BodyState& there) {
    return Blended<float>(at, blend, in.arrival.angle, in.arrival.spin, in.target_then.angle,
                          in.target_then.spin, there.angle);
  };
  Correction out;
  const Vec2 way = path(t + in.step, in.target_next) - path(t, in.target);
  out.now.velocity = (way - in.drift.position) / in.step - in.local.velocity;
  if (std::fabs(in.target.spin) < kPvbSpinFollowed) {
    out.now.spin =
        (turn(t + in.step, in.target_next) - turn(t, in.target)) / in.step - in.local.spin;
  } else {
    out.now.spin = in.target_next.spin - in.local.spin;
  }
  if (in.coupled) out.now = PlusScaled(BodyState{}, out.now, kCoupledShare);
  return out;
}

}  // namespace seam
