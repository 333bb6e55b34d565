#pragma once
/// States packed as bits: the message and its bound.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/base/limits.h"

namespace seam {

/// Both directions: States, coded as differences from acknowledged states. Written by StatesPacker,
/// read by StatesUnpacker.
struct PackedStates {
  std::vector<std::uint8_t> data;  ///< 1..kPackedBytesMax bytes
};

/// The answer to a PackedStates that StatesUnpacker refused, at once: its sender counts no state up
/// to that message as known (StatesPacker::Reset).
struct Reset {
  std::int16_t number = 0;  ///< the lowest 16 bits of the message's number
};

/// Client -> server -> authority: received states of these mechanisms differ from the sender's own
/// simulation.
struct Differing {
  std::vector<std::int32_t> mechanism;  ///< 1..kDifferingMax mechanism ids
};

/// Most bytes of data in one PackedStates: with the 10 bytes before, it must fit kMessageBytesMax.
constexpr std::size_t kPackedBytesMax = 1140;
static_assert(10 + kPackedBytesMax <= kMessageBytesMax);

}  // namespace seam
