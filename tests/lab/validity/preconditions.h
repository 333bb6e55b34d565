#pragma once
/// What must have happened in a run for its figures to mean what their row says.

#include <string>

#include "common/measure/measure.h"
#include "common/net/impair.h"
#include "common/scene/scene.h"

namespace seam {

/// All that a run is judged by.
struct RunFacts {
  const Scene& scene;
  const Recording& recording;
  const Oracle& oracle;  ///< of ComputeOracle, so that it has looked for contacts
  const Measures& measures;
  const ImpairProfile& network;
  ImpairedTraffic traffic;
};

/// Empty when all holds, else the first that does not: what the scene expects (common/scene/
/// expected.h; a hand-over only in the modes that have them), that somebody's view was compared,
/// and that the network lost at least 0.9 of what its profile says, as far as chance allows: three
/// standard deviations below that. No comma, no line end.
std::string InvalidReason(const RunFacts& run);

/// Whether `lost` of `offered` datagrams are too few for the profile; see InvalidReason.
bool LossTooSmall(const ImpairProfile& profile, const ImpairedTraffic& traffic);

}  // namespace seam
