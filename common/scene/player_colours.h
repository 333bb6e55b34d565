#pragma once
/// Reads the colours that a scene gives its players; only pictures need them.

#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace seam {

/// Returns by player: "#rrggbb", "1" to "10" of the palette, or "" for the colour of its peer.
/// Empty for a scene that was not read from a text.
std::vector<std::string> PlayerColours(const Scene& scene);

}  // namespace seam
