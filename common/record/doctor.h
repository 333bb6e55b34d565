#pragma once
/// Diagnoses "why do I see nothing on the bus?": checks LCM's requirements and names remedies.

#include <string>
#include <vector>

namespace seam {

struct DoctorReport {
  bool healthy = true;             ///< messages arrive; warnings do not make it false
  std::vector<std::string> lines;  ///< each begins with "ok", "warning" or "BROKEN"
};

/// Checks the multicast route, the reach of messages, the receive buffer limit, the stock tools,
/// and that a small and the largest message on a scratch channel come back within a second. Takes
/// up to 12 s behind a firewall. Never throws; needs no privileges. `url` as for Bus.
DoctorReport RunDoctor(const std::string& url);

/// Returns the time to live in an LCM url ("udpm://...?ttl=1"), in networks; 0, LCM's default,
/// without one: messages stay on the machine.
int TtlOf(const std::string& url);

/// Returns the interface for `address` (a.b.c.d) in the kernel's table `routes` (the text of
/// /proc/net/route); "" if there is none.
std::string RouteInterface(const std::string& routes, const std::string& address);

}  // namespace seam
