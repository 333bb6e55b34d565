#pragma once
/// Selects the impacts of a recording to be marked: collisions, not the many small impulses of a
/// rolling wheel or a resting stack.

#include <vector>

#include "common/record/recording.h"
#include "common/scene/types.h"

namespace seam {

/// A marked impact.
struct Mark {
  double tick = 0;
  Vec2 point{0, 0};  ///< m
  float dv = 0;      ///< m/s
};

/// Returns the marks of a peer's world in (tick - span, tick], ticks. Leaves out repeated impacts
/// of a pair of bodies with similar strength.
std::vector<Mark> MarksBefore(const Recording& recording, int peer, double tick, double span);

}  // namespace seam
