#pragma once
/// Sums and differences of body states, and their extrapolation.

#include "common/scene/types.h"

namespace seam {

/// a - b, component by component.
BodyState Minus(const BodyState& a, const BodyState& b);
/// a + s b, component by component.
BodyState PlusScaled(const BodyState& a, const BodyState& b, float s);
/// Returns Xr' = Xr extrapolated by its own velocity for dt.
BodyState Extrapolate(const BodyState& remote, float dt);
/// True if position and angle, whole turns included, are bit for bit the same.
inline bool SamePose(const BodyState& a, const BodyState& b) {
  return a.position == b.position && a.angle == b.angle;
}

}  // namespace seam
