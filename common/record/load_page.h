#pragma once
/// Writes and reads a server's Loads as the text that Prometheus scrapes (exposition format 0.0.4),
/// with histograms of all ticks, which are only in this page.

#include <cstdint>
#include <string>
#include <vector>

#include "common/base/bucket_histogram.h"
#include "common/codec/messages.h"

namespace seam {

struct RoomLoad {
  std::string room;
  Load load;
  /// Wall time and lateness of all ticks since the start. Empty if the Load came from the bus.
  BucketHistogram tick{}, late{};
};

/// Returns the page: one metric after the other, each with a sample per room (docs/server.md).
std::string WriteLoadPage(const std::vector<RoomLoad>& loads);

/// Reads the output of WriteLoadPage, in the order of the rooms; skips unknown metrics. Times are
/// exact to the microsecond. utime and sequence are 0.
std::vector<RoomLoad> ReadLoadPage(const std::string& text);

/// Returns the name of a kind of traffic (kTrafficStates...) in the page and seam-top: "states".
const char* TrafficName(int kind);

}  // namespace seam
