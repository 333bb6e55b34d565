#pragma once
/// States as bits: the message, and its bound.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/base/limits.h"

namespace seam {

/// Server -> client: States, as differences from those that the client is known to have got.
/// StatesPacker writes and StatesUnpacker reads them.
struct PackedStates {
  std::vector<std::uint8_t> data;  ///< 1..kPackedBytesMax bytes
};

/// Most bytes of data in one PackedStates: with 10 before them they must fit kMessageBytesMax.
constexpr std::size_t kPackedBytesMax = 1140;
static_assert(10 + kPackedBytesMax <= kMessageBytesMax);

}  // namespace seam
