#pragma once
/// Answers "why do I see nothing on the bus?": looks at what LCM needs and says what to type.

#include <string>
#include <vector>

namespace seam {

struct DoctorReport {
  bool healthy = true;             ///< messages arrive; warnings do not count against it
  std::vector<std::string> lines;  ///< each begins with "ok", "warning" or "BROKEN"
};

/// Checks the multicast route, the limit of receive buffers, the stock tools, and that a small and
/// the largest message sent on a scratch channel come back within a second. Takes up to 12 s when
/// a firewall is in the way. Never throws. `url` as for Bus; needs no privileges.
DoctorReport RunDoctor(const std::string& url);

/// The interface that the kernel's table `routes` (the text of /proc/net/route) sends `address`
/// (a.b.c.d) to; "" when it has none.
std::string RouteInterface(const std::string& routes, const std::string& address);

}  // namespace seam
