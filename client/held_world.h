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

/// Gives the replica all that was heard: each body begins where its newest state takes it by now,
/// then what rests is put at rest.
void GiveHeld(const std::vector<Bytes>& held, Replica& replica);

}  // namespace seam
