#pragma once
/// Conversion of states to and from the quanta of the wire.

#include <vector>

#include "common/codec/messages.h"
#include "common/codec/quanta.h"
#include "common/codec/wire_body.h"
#include "common/scene/types.h"

namespace seam {

/// Rounds every field to its quantum; id, tick, epoch and flags are left out. Speeds beyond 127 m/s
/// and 127 rad/s are clamped to it.
WireBody Quantise(const BodyState& state);

/// Splits bodies into messages of at most kStatesBodiesMax, each within kOriginReach of its origin.
/// The header fields (utime, peer, tick, revision, composition) are copied from `header`.
std::vector<States> Pack(const States& header, const std::vector<WireBody>& bodies);

/// Returns the state that a receiver has; the angle is unwrapped to the turn nearest `near_angle`.
BodyState Unpack(const WireBody& body, float near_angle);
/// Returns that of entry `i` of a message.
BodyState Unpack(const States& states, std::size_t i, float near_angle);

}  // namespace seam
