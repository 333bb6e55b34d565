#pragma once
/// The last thing a program does with its network.

#include <algorithm>
#include <cstdint>

#include "common/base/process.h"
#include "common/net/impair.h"
#include "common/net/udp.h"

namespace seam {

/// Longest that a goodbye may be under way, us; the slowest profile (soak) holds it for 1 s.
constexpr std::int64_t kFarewellUsMax = 3000000;

/// Lets what was sent through the simulated network before the program ends: without this a
/// goodbye would not be sent. Takes as long as the profile delays, at most kFarewellUsMax; what
/// arrives meanwhile is of no interest any more.
inline void LetThrough(UdpNet& udp, ImpairedNet& net) {
  const std::int64_t deadline = SteadyClockUs() + kFarewellUsMax;
  for (std::int64_t now = 0; net.sending() && (now = SteadyClockUs()) < deadline;) {
    udp.Wait(std::clamp<std::int64_t>(net.next_due_us() - now, 0, 20000));
    net.Advance(SteadyClockUs());
    net.Flush();
  }
}

}  // namespace seam
