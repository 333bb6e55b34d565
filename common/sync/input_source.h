#pragma once
/// Where a player's inputs come from when no keyboard is attached: the scene's script, or a bot.

#include "common/scene/scene.h"

namespace seam {

/// The scene's script of `player` at `tick`.
Input ScriptedInput(const Scene& scene, int player, std::int64_t tick);

/// Random throttle, brake and rest, held for 0.2 to 1.2 s each: a function of seed, player and tick
/// alone, so that any peer and any oracle can repeat it.
Input BotInput(std::int64_t seed, int player, std::int64_t tick, int tick_hz);

}  // namespace seam
