#pragma once
/// Conversion of states to the wire: integers in fixed quanta.

#include <vector>

#include "common/codec/messages.h"
#include "common/codec/quanta.h"
#include "common/scene/types.h"

namespace seam {

/// Returns the state that a receiver will have: every field rounded to its quantum. Idempotent. The
/// angle keeps its revolutions. Speeds beyond the int16 range (128 m/s, 128 rad/s) are clamped to
/// it.
BodyState Quantised(const BodyState& state);

/// One body's entry in a States message.
struct PackedBody {
  PartId id = 0;
  std::int32_t epoch = 0;
  std::int8_t flags = 0;
  BodyState state;
};

/// Splits bodies into messages of at most kStatesBodiesMax, each within 60 m of its origin. The
/// header fields (utime, peer, tick, composition) are copied from `header`.
std::vector<States> Pack(const States& header, const std::vector<PackedBody>& bodies);

/// Returns entry `i` of a message; the angle is unwrapped to the turn nearest `near_angle`.
BodyState Unpack(const States& states, std::size_t i, float near_angle);

}  // namespace seam
