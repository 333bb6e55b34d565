#pragma once
/// Differences between peers, told on the bus (lcmtypes/divergence_t.lcm).

#include <cstddef>
#include <cstdint>
#include <vector>

namespace seam {

/// Bus only: states heard that differ from the peer's own of the same tick, since the message
/// before; of each body the greatest difference.
struct Divergence {
  std::int64_t utime = 0;
  std::int64_t session = 0, sequence = 0;
  std::int32_t peer = 0;
  std::int64_t tick = 0;              ///< the peer's newest
  std::int32_t more = 0;              ///< bodies that found no room
  std::vector<std::int32_t> body;     ///< ids, ascending
  std::vector<std::int64_t> at;       ///< tick of the states
  std::vector<std::int16_t> holder;   ///< the peer that told the state
  std::vector<std::int16_t> missing;  ///< players whose inputs of that tick were not known
  std::vector<float> apart, kick;     ///< m, m/s
};
constexpr std::size_t kDivergenceMax = 64;

}  // namespace seam
