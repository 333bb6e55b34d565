#pragma once
/// The colours that a scene gives its players, which only pictures ask for.

#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace seam {

/// By player: "#rrggbb", "1" to "10" of the palette, or "" for its peer's colour. Empty for a scene
/// that was not read from a text.
std::vector<std::string> PlayerColours(const Scene& scene);

}  // namespace seam
