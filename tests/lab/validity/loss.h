#pragma once
/// What a network must have done for a run to mean what its row says.

#include "common/net/impair.h"

namespace seam {

/// Whether `lost` of `offered` datagrams are fewer than 0.9 of what the profile says, by more than
/// chance allows: three standard deviations. False where there are too few datagrams to say.
bool LossTooSmall(const ImpairProfile& profile, const ImpairedTraffic& traffic);

}  // namespace seam
