/// Corrector: bodies whose role changed. What is simulated from now on begins as the authority's,
/// what is displayed from now on goes on from where it is.

#include "common/base/geometry.h"
#include "common/sync/correct/corrector.h"
#include "common/sync/state_limits.h"

namespace seam {

void Corrector::FollowRoles() {
  const std::int64_t now = world_.tick();
  for (int body = 0; body < world_.body_count(); ++body) {
    const Motion wanted = roles_.Simulates(body) ? Motion::kDynamic : Motion::kKinematic;
    if (world_.motion(body) == wanted) continue;
    // What was simulated here is from now on reckoned from where it is, not from what was last
    // heard of it, which may be from before this peer had the authority.
    if (wanted == Motion::kKinematic) memory_.snapshots().Add(body, now, world_.Read(body));
    world_.SetMotion(body, wanted);
    if (wanted != Motion::kDynamic || !memory_.snapshots().has(body)) continue;
    // What was only displayed had the velocity of its display, not of a body: start from the
    // authority's.
    const BodyState before = world_.Read(body);
    BodyState state = memory_.snapshots().Extrapolate(body, now, world_.dt(), kReckonMax);
    state.angle = UnwrapAngle(state.angle, before.angle);
    world_.Write(body, state);
    display_.Moved(body, Minus(state, before));
    memory_.track(body).dynamic_since = now;
    if (BodyState* past = memory_.history().At(now, body)) *past = state;
  }
}

}  // namespace seam
