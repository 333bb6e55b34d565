#pragma once
/// What ends the rest of a whole island at once, when it happens and in a replay that finds it out:
/// a blow to one of its bodies, or a player's input to one of its mechanisms. Smaller disturbances
/// may be no more than a correction (RestCommit).

#include <vector>

#include "common/physics/world.h"
#include "common/sync/body_memory.h"
#include "common/sync/input_track.h"
#include "common/sync/reach/driven.h"

namespace seam {

/// What moves faster than this was struck, m/s and rad/s.
constexpr float kRestBlow = 0.5f;

/// By mechanism: whether a player whose axes move it, or whose it is, does something in this tick.
/// `inputs`: by player.
std::vector<bool> DrivenIn(const World& world, const Drivers& drivers,
                           const std::vector<InputTrack>& inputs, std::int64_t tick);

/// After a step: the bodies that are held at rest but were woken by it, in islands whose rest it
/// ended; ascending in each island.
std::vector<int> DisturbedRest(const World& world, const Drivers& drivers, const BodyMemory& memory,
                               const std::vector<InputTrack>& inputs);

}  // namespace seam
