#pragma once
/// Time that the core adds to a step of the engine, measured side by side.

#include "common/scene/scene.h"

namespace seam {

struct Overhead {
  int bodies = 0;               ///< that move
  double raw_us_per_step = 0;   ///< b2World::Step, as often as a tick has substeps
  double core_us_per_step = 0;  ///< World::Step
  bool equal = false;           ///< both ended in the same state, bit for bit
  double ratio() const { return core_us_per_step / raw_us_per_step; }
};

/// Steps both through `ticks` ticks with the scene's scripts, a stretch of some ticks each in turn,
/// `repeats` times. The same work comes back in every repeat: of each stretch the least CPU time
/// counts, which is that without the machine's interruptions.
Overhead MeasureOverhead(const Scene& scene, int ticks, int repeats);

}  // namespace seam
