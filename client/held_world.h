#pragma once
/// What is heard of the room's bodies before a client begins to step: who joins late is to begin
/// with the world as it is, not with the scene's beginning.

#include <cstdint>
#include <vector>

#include "common/base/bytes.h"
#include "common/sync/replica.h"

namespace seam {

/// Whether each of the world's bodies has been heard of since the world is composed as it is: in
/// motion (states_t), not before tick `from`, or at rest (rest_t). `held` are messages that decode.
bool CoversWorld(const std::vector<Bytes>& held, const World& world, std::int64_t from);

/// The latest tick of which everything that moves is known, `oldest` to `now`; that from which on
/// everything is known, if it is later.
std::int64_t TickOfWorld(const std::vector<Bytes>& held, const World& world, std::int64_t oldest,
                         std::int64_t now);

/// Gives the replica all that was heard: each body begins where its newest state up to the
/// replica's tick takes it by then, or lies where it has come to rest since. What is told of later
/// ticks waits for them.
void GiveHeld(const std::vector<Bytes>& held, Replica& replica);

}  // namespace seam
