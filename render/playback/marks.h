#pragma once
/// Which impacts of a recording are worth a mark: a collision, not the thousand small pushes of a
/// wheel that rolls or a stack that rests.

#include <vector>

#include "common/record/recording.h"
#include "common/scene/types.h"

namespace seam {

struct Mark {
  double tick = 0;
  Vec2 point{0, 0};  ///< m
  float dv = 0;      ///< m/s
};

/// Marks of a peer's world in (tick - span, tick], ticks. A pair of bodies that met with a similar
/// strength shortly before has none.
std::vector<Mark> MarksBefore(const Recording& recording, int peer, double tick, double span);

}  // namespace seam
