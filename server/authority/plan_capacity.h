#pragma once
/// A slow machine simulates less: whole islands go to the server, the farthest first.

#include "server/authority/islands.h"

namespace seam {

/// Takes from each player whose capacity is limited what it cannot step: its vehicles count first,
/// then islands from the nearest on. What it has it keeps up to its capacity (kShed); new ones it
/// gets up to kAdmit of it. The server has the rest.
void LimitToCapacity(const AuthorityView& view, const PlayerOfPeer& players, const Islands& islands,
                     AuthorityPlan* plan);

/// Shares of a player's capacity. Equal ones would let islands come and go with every plan.
constexpr float kAdmit = 0.8f, kShed = 1.0f;

}  // namespace seam
