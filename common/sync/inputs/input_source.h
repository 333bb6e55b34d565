#pragma once
/// Inputs of a player without a keyboard: from the scene's script, or from a bot.

#include "common/scene/scene.h"

namespace seam {

/// Returns the script's input of `player` at `tick`.
Input ScriptedInput(const Scene& scene, int player, std::int64_t tick);

/// Returns random throttle, brake and rest, each held for 0.2 to 1.2 s. A function of seed, player
/// and tick alone, so that any peer and any oracle can repeat it.
Input BotInput(std::int64_t seed, int player, std::int64_t tick, int tick_hz);

}  // namespace seam
