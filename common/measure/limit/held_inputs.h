#pragma once
/// Inputs held: the error of exact physics from the exact state, with the other players' inputs as
/// far as they had arrived, then held. A guess that is hard to beat, and not a bound: a method that
/// guesses inputs better than by holding them has a smaller error.

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "common/measure/oracle.h"

namespace seam {

/// Newest known inputs, by source player (first) and receiving player (second), then by tick from 0
/// to recording.last_tick: the newest tick of the source's inputs that the receiver can know when
/// its screen shows that tick, never a later one; -1: none.
using KnownInputs = std::map<std::pair<int, int>, std::vector<std::int64_t>>;
/// Finds the known inputs from the server's clock, the times at which the server received inputs,
/// and the players' round trips; docs/metrics.md has the formula. Players without inputs are
/// absent; empty when the recording has no views of the server.
KnownInputs FindKnownInputs(const Recording& recording);

/// Returns the RMS displacement, m, of bodies that are not a player's own, between the truth and
/// the prediction of this player for that tick, over all players and every
/// `every`-th tick:
///
///   truth of tick f --- exact physics; own inputs exact, each other player's inputs as
///                       recorded up to what FindKnownInputs says, then held ---> tick t
///
/// with f the newest multiple of `every` that is not after any of these. The world has a barrier at
/// every `every`-th tick, so that it is exactly 0 where no held input differs. Ticks with an
/// edit between f and t are left out. nullopt: every input is known to all (mode oracle, one
/// player, or no inputs), or there is no such tick. Costs one oracle, and t - f ticks for each
/// player and tick at which an input is held wrongly. Throws as ComputeOracle does.
std::optional<double> HeldInputsError(const Recording& recording, int every = 2);

}  // namespace seam
