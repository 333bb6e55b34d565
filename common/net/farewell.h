#pragma once
/// Drains a program's network before it exits.

#include <algorithm>
#include <cstdint>

#include "common/base/process.h"
#include "common/net/impair.h"
#include "common/net/udp.h"

namespace seam {

/// Longest time to wait for a Bye to get through, us; the slowest profile (soak) delays it by 1 s.
constexpr std::int64_t kDrainUsMax = 3000000;

/// Waits until the simulated network has passed on all datagrams sent. Without this a Bye would
/// never leave the process. Takes as long as the profile's delay, at most kDrainUsMax; datagrams
/// that arrive meanwhile are ignored.
inline void DrainNetwork(UdpNet& udp, ImpairedNet& net) {
  const std::int64_t deadline = SteadyClockUs() + kDrainUsMax;
  for (std::int64_t now = 0; net.sending() && (now = SteadyClockUs()) < deadline;) {
    udp.Wait(std::clamp<std::int64_t>(net.next_due_us() - now, 0, 20000));
    net.Advance(SteadyClockUs());
    net.Flush();
  }
}

}  // namespace seam
