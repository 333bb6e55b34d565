/// Blender: pulls copies in every tick between two messages.

#include "common/base/geometry.h"
#include "common/sync/blend/blender.h"
#include "common/sync/state_limits.h"

namespace seam {
namespace {

/// The authority's state is extrapolated by at most this, s (BeamMP's value). Longer puts a car
/// that braked into the next street.
constexpr float kPullReckonMax = 0.3f;

}  // namespace

BodyState Blender::PullTarget(int body, std::int64_t at) const {
  BodyState target = memory_.snapshots().ExtrapolateNewest(body, at, world_.dt(), kPullReckonMax);
  target.angle = UnwrapAngle(target.angle, world_.Read(body).angle);
  return target;
}

void Blender::RecordArrival(int body) {
  if (config_.pull == nullptr) return;
  memory_.track(body).pull.arrived = world_.tick();
}

void Blender::Pull() {
  if (config_.pull == nullptr) return;
  const std::int64_t now = world_.tick();
  PullInput in;
  const float dt = world_.dt();
  in.drift.velocity = dt * world_.scene().gravity;
  in.step = dt;
  for (const int body : world_.present()) {
    BodyTrack& track = memory_.track(body);
    PullTrack& pull = track.pull;
    if (pull.arrived < track.dynamic_since) continue;
    if (pull.arrived < 0 || roles_.RoleOfBody(body) != kRoleSecondary) continue;
    // A state from before an impact would undo the impact.
    if (memory_.snapshots().newest_tick(body) <= track.last_impact_tick) continue;
    in.local = world_.Read(body);
    in.target = PullTarget(body, now);
    if (Negligible(Minus(in.target, in.local))) continue;
    const Correction c = config_.pull(in, &pull.memory);
    pull.memory.before = in.local.velocity;
    pull.memory.asked = c.now.velocity;
    world_.Write(body, WithinLimits(PlusScaled(in.local, c.now, 1), world_.scene().speed_limit));
  }
}

}  // namespace seam
