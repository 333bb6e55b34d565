#pragma once
/// A scene all of whose players do the same at random: in a mirrored scene nobody can know what the
/// other will do, and yet both sides stay each other's mirror image.

#include <cstdint>
#include <string>

#include "common/scene/scene.h"

namespace seam {

/// The text of `scene` with every player's script replaced by what a bot of the first player does
/// with `seed` (BotInput), for `seconds`. Buttons are left alone. Requires a script of each player
/// to begin a line, as ours do; else the result has two and does not parse.
std::string WithMirroredBots(const Scene& scene, std::int64_t seed, double seconds);

}  // namespace seam
