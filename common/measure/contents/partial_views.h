#pragma once
/// Which views of a recording show a part of the bodies only, as those of `--publish own` do.

#include <cstddef>
#include <functional>
#include <map>
#include <string>

#include "common/record/recording.h"
#include "common/scene/scene.h"

namespace seam {

/// How many bodies the views of a peer have, of how many that there were: means over its ticks.
struct ShownBodies {
  double shown = 0, of = 0;
};

/// By peer, those whose views lack bodies. Requires a scene that ParseScene accepted.
std::map<int, ShownBodies> PartialViews(const Scene& scene, const Recording& recording);

/// What `partial` says, in a line: whose views, with three names, and what follows from it. ""
/// where all views show all. `name_of`: of a peer.
std::string PartialViewsText(const std::map<int, ShownBodies>& partial,
                             const std::function<std::string(int)>& name_of);

}  // namespace seam
