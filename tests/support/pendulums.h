#pragma once
/// A scene with many hand-overs, and the duration of each.

#include <string>
#include <vector>

#include "common/record/recording.h"

namespace seam {

/// Makes a scene of `count` pendulums that swing over the seam between ann and bob and do not
/// touch; each is handed over about every three seconds, for 20 s.
std::string Pendulums(int count);

/// Returns the times from each revocation to the grant of the epoch after it, ms, ascending.
std::vector<double> HandOverMs(const Recording& recording);

}  // namespace seam
