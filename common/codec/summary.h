#pragma once
/// A session summed up, told on the bus (lcmtypes/summary_t.lcm).

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace seam {

/// How a session is when it is summed up.
enum class Ended : std::int8_t { kNot, kEnded, kKilled };

struct Summary {
  std::int64_t utime = 0;
  std::int64_t session = 0, sequence = 0;  ///< session: never 0
  std::int64_t tick = 0;
  std::int64_t of = 0;    ///< the session that is summed up
  std::int8_t ended = 0;  ///< Ended
  std::int64_t ticks = 0, late_ticks = 0, edits = 0, hand_overs = 0;
  std::int64_t events = 0, events_dropped = 0;
  std::int32_t clients = 0;  ///< in all; the first kSummaryClientsMax follow
  std::string names;         ///< separated by spaces
  std::vector<std::int32_t> peer, player, joins, rejoins;
  std::vector<std::int64_t> present_ticks;
  std::vector<float> score;
  std::vector<std::int64_t> bytes_in, bytes_out;
  std::vector<std::int32_t> rtt_us, rtt_worst_us, loss_ppm;  ///< -1: unknown
  std::vector<std::int64_t> corrections;
  std::vector<std::int64_t> malformed, stale, right, implausible, budget;  ///< dropped
  std::vector<std::int64_t> hand_overs_to;
  std::vector<std::int8_t> trust;  ///< step, as in Audit
};
/// Most clients in one Summary: 150 bytes each within kBusMessageBytesMax.
constexpr std::size_t kSummaryClientsMax = 380;

}  // namespace seam
