/// snap: X = Xr. The baseline: always behind by the latency.

#include "common/sync/blend/reconcile.h"

namespace seam {

Correction ReconcileSnap(const ReconcileInput& in) {
  Correction out;
  out.now = Minus(in.remote, in.local);
  return out;
}

}  // namespace seam
