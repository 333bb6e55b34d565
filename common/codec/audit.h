#pragma once
/// The server's doubts about clients, told on the bus (lcmtypes/audit_t.lcm).

#include <cstddef>
#include <cstdint>
#include <vector>

namespace seam {

/// Bus only: a doubt of the server about a client (docs/trust.md).
struct Audit {
  std::int64_t utime = 0;
  std::int64_t session = 0, sequence = 0;  ///< session: never 0
  std::int64_t tick = 0;
  std::int32_t peer = 0;
  std::int32_t player = 0;
  std::int32_t body = -1;  ///< id; -1: about a step
  std::int8_t refused = 0;
  std::int32_t score_milli = 0;  ///< 1/1000
  std::int8_t step = 0;
  std::vector<float> told, expected;  ///< x, y, m; vx, vy, m/s; empty: about a step
};
constexpr std::int8_t kAuditStepMax = 5;
constexpr std::size_t kAuditNumbers = 4;

}  // namespace seam
