/// interleave: X = Xl/2 + Xr/2. After Kevin He (2012), "buffer zone": both results are mixed.

#include "common/sync/blend/reconcile.h"

namespace seam {

Correction ReconcileInterleave(const ReconcileInput& in) {
  Correction out;
  out.now = PlusScaled(BodyState{}, Minus(in.remote, in.local), 0.5f);
  return out;
}

}  // namespace seam
