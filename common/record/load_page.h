#pragma once
/// Writes and reads a server's Loads as the text that Prometheus scrapes (exposition format 0.0.4),
/// with histograms of all ticks, which are only in this page.

#include <cstdint>
#include <string>
#include <vector>

#include "common/base/bucket_histogram.h"
#include "common/codec/messages.h"

namespace seam {

/// The room's connections, since the start; each client is read once a second.
struct Connections {
  /// Round trip; delay that our own traffic adds to it; share lost on the way to the server, ppm.
  BucketHistogram round_trip{}, queue{}, loss{};
  BucketHistogram corrected{};    ///< distance of a correction of the server's copy, um
  std::int64_t compositions = 0;  ///< clients with other bodies than the server: repaired
  std::int64_t rests = 0;         ///< clients without some bodies at rest: sent again
  std::int64_t least_line = 0;    ///< least budget of a client now, bytes/s
  std::int64_t thin_lines = 0;    ///< clients whose path was full once, and is the limit now
  std::int64_t loadless = 0;      ///< proposed breaks of glue that bore no load
  std::int64_t doubts = 0;        ///< messages with states that differ from what is expected
  std::int64_t distrusted = 0;    ///< players whose bodies the server holds now for their doubts
  std::int64_t unkept = 0;        ///< 1: the log, a snapshot or the store could not be written
};

struct RoomLoad {
  std::string room;
  Load load;
  // Only in the page; empty if the Load came from the bus.
  BucketHistogram tick{}, late{};  ///< wall time and lateness of all ticks since the start
  Connections connections{};
};

/// Returns the page: one metric after the other, each with a sample per room (docs/server.md).
std::string WriteLoadPage(const std::vector<RoomLoad>& loads);

/// Reads the output of WriteLoadPage, in the order of the rooms; skips unknown metrics. Times are
/// exact to the microsecond. utime and sequence are 0.
std::vector<RoomLoad> ReadLoadPage(const std::string& text);

/// Returns the name of a kind of traffic (kTrafficStates...) in the page and seam-top: "states".
const char* TrafficName(int kind);

}  // namespace seam
