#pragma once
/// The time after which an unreliable message counts as lost.

#include <cstdint>

namespace seam {

/// Returns the time without acknowledgement after which a message counts as lost, us: as for
/// reliable messages, and a little more, since a client with nothing to send acknowledges late.
/// `rtt_us`: the round trip, -1: not known.
inline std::int64_t LateUs(std::int64_t rtt_us) {
  constexpr std::int64_t kUnknownUs = 250000, kMoreUs = 50000;
  return (rtt_us < 0 ? kUnknownUs : rtt_us + rtt_us / 4) + kMoreUs;
}

}  // namespace seam
