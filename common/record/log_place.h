#pragma once
/// A place in a log at which it can be gone on with.

#include <cstdint>

#include "common/record/keyed_chain.h"

namespace seam {

/// The end of a part of a log that ends with a LogSeal.
struct LogPlace {
  std::int64_t bytes = 0;   ///< in its segment
  std::int64_t number = 0;  ///< of the next event
  std::uint32_t crc = 0;    ///< log_crc of that seal; 0: the log's begin
  KeyedChain::Hash keyed{};  ///< log_keyed of that seal; zeros: it has none
  std::int64_t tick = 0;     ///< of that seal; 0: not known
  std::int32_t segment = 0;  ///< SegmentPath
};

}  // namespace seam
