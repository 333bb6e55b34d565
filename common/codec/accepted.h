#pragma once
/// A client's message that the server has taken, for the log (lcmtypes/accepted_t.lcm).

#include <cstddef>
#include <cstdint>
#include <vector>

namespace seam {

/// Bus only: an encoded message of the edge, or an LcmHeard. Accepted states, inputs and edits are
/// on the bus as they are.
struct Accepted {
  std::int64_t utime = 0;
  std::int64_t session = 0;  ///< never 0
  std::int32_t sequence = 0;
  std::int32_t peer = 0;
  std::int32_t player = -1;
  std::vector<std::uint8_t> data;
};
constexpr std::size_t kAcceptedBytesMax = 4096;

}  // namespace seam
