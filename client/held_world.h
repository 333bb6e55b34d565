#pragma once
/// What is heard of the room's bodies before a client begins to step: who joins late is to begin
/// with the world as it is, not with the scene's beginning.

#include <vector>

#include "common/base/bytes.h"
#include "common/sync/replica.h"

namespace seam {

/// Whether each of the world's bodies has been heard of, in motion (states_t) or at rest (rest_t),
/// since the world is composed as it is. `held` are messages that decode.
bool CoversWorld(const std::vector<Bytes>& held, const World& world);

/// Gives the replica all that was heard: each body begins where its newest state takes it by now,
/// then what rests is put at rest.
void GiveHeld(const std::vector<Bytes>& held, Replica& replica);

}  // namespace seam
