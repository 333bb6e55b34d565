#pragma once
/// Finds the views of a recording that lack some of the bodies, as those of `--publish own` do.

#include <cstddef>
#include <functional>
#include <map>
#include <string>

#include "common/record/recording.h"
#include "common/scene/scene.h"

namespace seam {

/// Mean number of bodies in a peer's views and mean number of existing bodies, over its ticks.
struct ShownBodies {
  double shown = 0, of = 0;
};

/// Returns, by peer, the views that lack bodies. Requires a scene that ParseScene accepted.
std::map<int, ShownBodies> PartialViews(const Scene& scene, const Recording& recording);

/// Formats `partial` as a line: at most three peers, the number of further ones, and the
/// consequence. "" where all views show all bodies. `name_of`: returns the name of a peer.
std::string PartialViewsText(const std::map<int, ShownBodies>& partial,
                             const std::function<std::string(int)>& name_of);

}  // namespace seam
