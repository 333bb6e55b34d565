#pragma once
/// Finds disturbances that end the rest of a whole island at once: an impact on one of its bodies,
/// or a player's input to one of its mechanisms. Used live and in replays. Smaller disturbances may
/// be mere corrections (see RestCommit).

#include <vector>

#include "common/physics/world.h"
#include "common/sync/body_memory.h"
#include "common/sync/input_track.h"
#include "common/sync/reach/driven.h"

namespace seam {

/// A body faster than this counts as struck, m/s.
constexpr float kRestImpactSpeed = 0.5f;

/// By mechanism: true if a player whose axes move it, or who owns it, gives any input in this tick.
/// `inputs`: by player.
std::vector<bool> DrivenIn(const World& world, const Drivers& drivers,
                           const std::vector<InputTrack>& inputs, std::int64_t tick);

/// Call after a step. Returns the held bodies that the step woke in islands that no longer rest;
/// ascending within each island.
std::vector<int> DisturbedRest(const World& world, const Drivers& drivers, const BodyMemory& memory,
                               const std::vector<InputTrack>& inputs);

}  // namespace seam
