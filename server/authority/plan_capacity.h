#pragma once
/// Capacity limits of slow machines: the server takes over whole islands, the farthest first.

#include "server/authority/islands.h"

namespace seam {

/// Reduces each player of limited capacity to the bodies it can step: first its vehicles, then
/// islands from the nearest on. It keeps held islands up to kShed of its capacity and gets new ones
/// up to kAdmit of it. The server gets the rest.
void LimitToCapacity(const AuthorityView& view, const PlayerOfPeer& players, const Islands& islands,
                     AuthorityPlan* plan);

/// Shares of a player's capacity. Equal shares would make islands change hands with every plan.
constexpr float kAdmit = 0.8f, kShed = 1.0f;

}  // namespace seam
