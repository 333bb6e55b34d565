#pragma once
/// The state that a receiver has of a body.

#include "common/sync/quantize.h"

namespace seam {

/// Returns the state with every field rounded to the wire's quantum. The angle keeps its
/// revolutions.
inline BodyState Quantised(const BodyState& state) { return Unpack(Quantise(state), state.angle); }

}  // namespace seam
