#pragma once
/// A scene with many hand-overs, and how long each took.

#include <string>
#include <vector>

#include "common/record/recording.h"

namespace seam {

/// `count` pendulums that swing over the seam between ann and bob and do not touch; each changes
/// hands about every three seconds, for 20 s.
std::string Pendulums(int count);

/// Milliseconds from each revocation to the grant of the epoch after it, ascending.
std::vector<double> HandOverMs(const Recording& recording);

}  // namespace seam
