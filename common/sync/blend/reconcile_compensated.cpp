/// compensated: Xr' = Xr + v dt, X = Xl/2 + Xr'/2. After Kevin He (2012), "lag compensation".
/// Wrong by g dt^2/2 in free fall and by the whole impulse just after an impact.

#include "common/sync/blend/reconcile.h"

namespace seam {

Correction ReconcileCompensated(const ReconcileInput& in) {
  Correction out;
  const BodyState moved_on = Extrapolate(in.remote, in.dt);
  out.now = PlusScaled(BodyState{}, Minus(moved_on, in.local), 0.5f);
  return out;
}

}  // namespace seam
