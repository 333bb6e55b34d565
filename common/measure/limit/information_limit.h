#pragma once
/// What nobody could have shown better over the recorded network: exact physics from the exact
/// state, with the others' inputs as far as they can have been known.

#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "common/measure/oracle.h"

namespace seam {

/// How old, in ticks, the newest input of one player (first) is where another one (second) is, in
/// the median over the recording, by the server's clock, the times at which the server took inputs,
/// and the players' round trips; docs/metrics.md says how. Players without inputs are absent; empty
/// when the recording has no views of the server.
std::map<std::pair<int, int>, std::int64_t> FindInputAges(const Recording& recording);

/// RMS displacement, m, of what is not a player's own, between the truth and what that player could
/// have known of it at that tick, over all players and every `every`-th tick:
///
///   truth of tick t - L --- exact physics; own inputs exact, each other player's inputs as
///                           recorded up to its age in FindInputAges, then held ---> tick t
///
/// with L the greatest of these ages. The truth has a barrier at each of those ticks, so that the
/// limit is exactly 0 where no held input differs. Ticks with an edit in between are left out.
/// nullopt: nothing is unknown to anybody (mode oracle, one player, or no inputs), or there is no
/// such tick. Costs one oracle, and for each player L ticks in `every`. Throws as ComputeOracle
/// does.
std::optional<double> InformationLimit(const Recording& recording, int every = 10);

}  // namespace seam
