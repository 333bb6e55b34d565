#pragma once
/// Gives all players of a scene the same random inputs: in a mirrored scene they are unpredictable,
/// and yet both sides stay mirror images of each other.

#include <cstdint>
#include <string>

#include "common/scene/scene.h"

namespace seam {

/// The text of `scene` with every player's script replaced by what a bot of the first player does
/// with `seed` (BotInput), for `seconds`. Buttons are left alone. Requires a script of each player
/// to begin a line, as ours do; else the result has two and does not parse.
std::string WithMirroredBots(const Scene& scene, std::int64_t seed, double seconds);

}  // namespace seam
