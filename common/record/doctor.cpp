#include "common/record/doctor.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

#include "common/base/check.h"
#include "common/codec/messages.h"
#include "common/record/bus.h"

namespace seam {
namespace {

constexpr const char* kAddRoute = "ip link set lo up multicast on; ip route add 224.0.0.0/4 dev lo";

std::string ReadText(const std::string& path) {
  std::ifstream file(path);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

/// Parses a.b.c.d into the number that /proc/net/route shows on a little-endian machine: the first
/// byte is the lowest.
bool ParseAddress(const std::string& text, unsigned* address) {
  unsigned a = 0, b = 0, c = 0, d = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%3u.%3u.%3u.%3u%c", &a, &b, &c, &d, &rest) != 4) return false;
  if (a > 255 || b > 255 || c > 255 || d > 255) return false;
  *address = a | b << 8 | c << 16 | d << 24;
  return true;
}

/// Returns the group in udpm://GROUP:PORT?..., or LCM's default.
std::string GroupOf(const std::string& url) {
  const std::size_t begin = url.find("://");
  const std::string rest = begin == std::string::npos ? "" : url.substr(begin + 3);
  const std::string group = rest.substr(0, rest.find_first_of(":?/"));
  return group.empty() ? "239.255.76.67" : group;
}

void CheckRoute(const std::string& group, DoctorReport* report) {
  const std::string interface = RouteInterface(ReadText("/proc/net/route"), group);
  if (interface.empty()) {
    report->lines.push_back("BROKEN   no route to " + group + ": as root type: " + kAddRoute);
    report->healthy = false;
  } else {
    report->lines.push_back("ok       multicast to " + group + " takes interface " + interface);
  }
}

/// Says how far messages go: LCM's default keeps them on the machine.
void CheckReach(const std::string& url, DoctorReport* report) {
  const int ttl = TtlOf(url);
  const std::string interface = RouteInterface(ReadText("/proc/net/route"), GroupOf(url));
  if (ttl <= 0) {
    report->lines.push_back(
        "ok       messages stay on this machine (ttl 0); ?ttl=1 in the url lets them out to the "
        "local network");
  } else if (interface == "lo") {
    report->lines.push_back("warning  ttl " + std::to_string(ttl) +
                            ", but multicast takes interface lo: nothing leaves this machine");
  } else {
    report->lines.push_back("ok       messages reach other machines, over at most " +
                            std::to_string(ttl) + " network(s)");
  }
}

void CheckBuffers(DoctorReport* report) {
  const std::string text = ReadText("/proc/sys/net/core/rmem_max");
  const long limit = std::atol(text.c_str());
  if (text.empty()) {
    report->lines.push_back("warning  the limit of receive buffers cannot be read here");
  } else if (limit < kBusReceiveBytes) {
    report->lines.push_back(
        "warning  receive buffers are limited to " + std::to_string(limit) +
        " bytes, bursts of "
        "large messages may be lost: as root type: sysctl -w net.core.rmem_max=" +
        std::to_string(kBusReceiveBytes));
  } else {
    report->lines.push_back("ok       receive buffers of " + std::to_string(kBusReceiveBytes) +
                            " bytes are allowed; for lcm-logger say "
                            "--lcm-url='udpm://239.255.76.67:7667?recv_buf_size=" +
                            std::to_string(kBusReceiveBytes) + "'");
  }
}

void CheckTools(DoctorReport* report) {
  const char* path = std::getenv("PATH");
  for (const char* tool : {"lcm-logger", "lcm-logplayer"}) {
    std::istringstream folders(path == nullptr ? "" : path);
    bool found = false;
    for (std::string folder; std::getline(folders, folder, ':');) {
      found = found || access((folder + "/" + tool).c_str(), X_OK) == 0;
    }
    report->lines.push_back(found ? std::string("ok       ") + tool + " is installed"
                                  : std::string("warning  no ") + tool +
                                        ": as root type: apt-get install liblcm-bin");
  }
}

/// Sends on a scratch channel and listens there.
void CheckBus(const std::string& url, DoctorReport* report) {
  try {
    Bus bus(url);
    const std::string channel = "SEAM_DOCTOR_" + std::to_string(getpid());
    std::size_t heard_bytes = 0;
    bus.Subscribe(channel, [&](const std::string&, std::int64_t, ByteView message) {
      heard_bytes = message.size;
    });
    for (const std::size_t size : {std::size_t{100}, kBusMessageBytesMax}) {
      bus.Publish(channel, 0, Bytes(size));
      for (int i = 0; i < 100 && heard_bytes != size; ++i) bus.Poll(10000);
      const bool heard = heard_bytes == size && bus.failures() == 0;
      report->lines.push_back((heard ? "ok       " : "BROKEN   ") + std::string("a message of ") +
                              std::to_string(size) + " bytes " +
                              (heard ? "comes back" : "does not come back within a second"));
      report->healthy = report->healthy && heard;
    }
  } catch (const OperatorError& error) {
    report->lines.push_back(std::string("BROKEN   ") + error.what());
    report->healthy = false;
  }
}

}  // namespace

int TtlOf(const std::string& url) {
  for (std::size_t at = url.find('?'); at != std::string::npos; at = url.find('&', at + 1)) {
    if (url.compare(at + 1, 4, "ttl=") == 0) return std::atoi(url.c_str() + at + 5);
  }
  return 0;
}

std::string RouteInterface(const std::string& routes, const std::string& address) {
  unsigned wanted = 0;
  if (!ParseAddress(address, &wanted)) return "";
  std::istringstream lines(routes);
  std::string line, best;
  unsigned long best_mask = 0;
  std::getline(lines, line);  // the headings
  while (std::getline(lines, line)) {
    char interface[64] = {};
    unsigned destination = 0, flags = 0, mask = 0;
    if (std::sscanf(line.c_str(), "%63s %x %*x %x %*d %*d %*d %x", interface, &destination, &flags,
                    &mask) != 4) {
      continue;
    }
    constexpr unsigned kRouteUp = 1, kRouteReject = 0x200;
    const bool usable = (flags & kRouteUp) != 0 && (flags & kRouteReject) == 0;
    // The mask's length decides; its leading bits are in the low bytes here.
    const unsigned long width = __builtin_bswap32(mask);
    if (!usable || (wanted & mask) != destination) continue;
    if (best.empty() || width > best_mask) {
      best = interface;
      best_mask = width;
    }
  }
  return best;
}

DoctorReport RunDoctor(const std::string& url) {
  DoctorReport report;
  const char* fallback = std::getenv("LCM_DEFAULT_URL");
  const std::string used = url.empty() && fallback != nullptr ? fallback : url;
  report.lines.push_back("ok       LCM url: " + (used.empty() ? "LCM's default" : used));
  if (used.empty() || used.compare(0, 7, "udpm://") == 0) {
    CheckRoute(GroupOf(used), &report);
    CheckReach(used, &report);
  }
  CheckBuffers(&report);
  CheckTools(&report);
  CheckBus(url, &report);
  return report;
}

}  // namespace seam
