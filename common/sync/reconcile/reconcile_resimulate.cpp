/// resimulate: go back to the tick of the message, put the authority's state in, and step again to
/// now with the inputs as they are known by now (replay.cpp). After the rollback of fighting games
/// (T. Cannon, GGPO, 2009), here with bodies of several authorities: our own are stepped again,
/// too, unless they press against another authority's.
///
/// What is here is the rule for what cannot be gone back to: a message older than the barriers that
/// are kept, or a copy that was not simulated then. Only what is far off is placed.

#include "common/sync/reconcile/reconcile.h"

namespace seam {
namespace {

/// Differences up to these, m and m/s, wait for a message that can be gone back to.
constexpr float kWaitsBelow = 0.25f, kWaitsBelowSpeed = 2.5f;

}  // namespace

Correction ReconcileResimulate(const ReconcileInput& in) {
  Correction out;
  const BodyState d = Minus(Extrapolate(in.remote, in.dt), in.local);
  if (d.position.norm() > kWaitsBelow || d.velocity.norm() > kWaitsBelowSpeed) out.now = d;
  return out;
}

}  // namespace seam
