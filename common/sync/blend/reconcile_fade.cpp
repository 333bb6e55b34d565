/// fade: X = (1 - e) Xl + e Xr', e = seconds since the last major impact, at most 1; a small
/// difference is left alone. After Kevin He (2012), "impact fade": just after an impact the
/// authority's message is still from before it, so our own result is better.

#include <algorithm>

#include "common/sync/blend/reconcile.h"

namespace seam {
namespace {

/// Difference that is left alone, m. Normal: a few quanta of position (1/512 m). Larger leaves
/// visible error standing; smaller lets two peers' resting copies chase each other.
constexpr float kKeepLocalBelow = 0.01f;

}  // namespace

Correction ReconcileFade(const ReconcileInput& in) {
  const BodyState difference = Minus(Extrapolate(in.remote, in.dt), in.local);
  if (difference.position.norm() < kKeepLocalBelow) return Correction{};
  Correction out;
  // Between touching bodies of two authorities, the article's full share is a feedback loop with
  // delay: a stack falls at 200 ms. A bounded share keeps it standing.
  const float most = in.coupled ? in.gain : 1.0f;
  out.now = PlusScaled(BodyState{}, difference, std::min(in.since_impact, most));
  return out;
}

}  // namespace seam
