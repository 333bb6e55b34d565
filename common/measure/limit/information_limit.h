#pragma once
/// What nobody could have shown better over the recorded network: exact physics from the exact
/// state, with the others' inputs as far as they can have been known.

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "common/measure/oracle.h"

namespace seam {

/// By player (first) and another one (second), by tick from 0 to recording.last_tick: the newest
/// tick of the first one's inputs that the other can know when its screen shows that tick, never a
/// later one; -1: none. By the server's clock, the times at which the server took inputs, and the
/// players' round trips; docs/metrics.md says how. Players without inputs are absent; empty when
/// the recording has no views of the server.
using KnownInputs = std::map<std::pair<int, int>, std::vector<std::int64_t>>;
KnownInputs FindKnownInputs(const Recording& recording);

/// RMS displacement, m, of what is not a player's own, between the truth and what that player could
/// have known of it at that tick, over all players and every `every`-th tick:
///
///   truth of tick f --- exact physics; own inputs exact, each other player's inputs as
///                       recorded up to what FindKnownInputs says, then held ---> tick t
///
/// with f the newest multiple of `every` that is not after any of these. The world has a barrier at
/// every `every`-th tick, so that the limit is exactly 0 where no held input differs. Ticks with an
/// edit in between are left out. nullopt: nothing is unknown to anybody (mode oracle, one player,
/// or no inputs), or there is no such tick. Costs one oracle, and t - f ticks for each player and
/// tick at which an input is held wrongly. Throws as ComputeOracle does.
std::optional<double> InformationLimit(const Recording& recording, int every = 2);

}  // namespace seam
