/// rollback: go back to the tick of the message or of a late input, write the authority's states,
/// and step again to now with the inputs known by now (replay.cpp). After the rollback of fighting
/// games (T. Cannon, GGPO, 2009), here with bodies of several authorities: own bodies are stepped
/// again too.
///
/// This file has the rule for a tick that cannot be reached: the message is older than the kept
/// barriers, or the copy was not simulated then. Only a copy that is far off is placed.

#include "common/sync/blend/reconcile.h"

namespace seam {
namespace {

/// Smaller differences, m and m/s, wait for a message whose tick can be reached.
constexpr float kWaitsBelow = 0.25f, kWaitsBelowSpeed = 2.5f;

}  // namespace

Correction ReconcileRollback(const ReconcileInput& in) {
  Correction out;
  const BodyState d = Minus(Extrapolate(in.remote, in.dt), in.local);
  if (d.position.norm() > kWaitsBelow || d.velocity.norm() > kWaitsBelowSpeed) out.now = d;
  return out;
}

}  // namespace seam
