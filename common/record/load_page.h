#pragma once
/// A server's Loads as the text that Prometheus scrapes (exposition format 0.0.4), and back; with
/// them histograms of all its ticks, which the page alone has.

#include <cstdint>
#include <string>
#include <vector>

#include "common/base/bucket_histogram.h"
#include "common/codec/messages.h"

namespace seam {

struct RoomLoad {
  std::string room;
  Load load;
  /// Of all ticks since its beginning: wall time, and how long after it was due each began. Of
  /// nothing where the Load was heard on the bus.
  BucketHistogram tick{}, late{};
};

/// One metric after the other, each with a sample per room: docs/server.md names them.
std::string WriteLoadPage(const std::vector<RoomLoad>& loads);

/// Reads what WriteLoadPage wrote, in the order of the rooms; what it does not know is left out.
/// Times come back to the microsecond. utime and sequence are 0.
std::vector<RoomLoad> ReadLoadPage(const std::string& text);

/// "states", as the page and seam-top call a kind of traffic; kTrafficStates...
const char* TrafficName(int kind);

}  // namespace seam
