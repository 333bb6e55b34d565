/// compensated: Xr' = Xr + v dt, X = Xl/2 + Xr'/2. After Kevin He (2012), "lag compensation".
/// Wrong by g dt^2/2 in free fall and by the whole impulse just after an impact.

#include <algorithm>

#include "common/sync/reconcile.h"

namespace seam {

Correction ReconcileCompensated(const ReconcileInput& in) {
  Correction out;
  const BodyState moved_on = Extrapolate(in.remote, in.dt);
  // Between bodies of two authorities that touch, half is too much when messages are old: it is a
  // feedback loop with delay, and a stack falls at 200 ms. Bounded, it stands.
  const float share = in.coupled ? std::min(in.gain, 0.5f) : 0.5f;
  out.now = PlusScaled(BodyState{}, Minus(moved_on, in.local), share);
  return out;
}

}  // namespace seam
