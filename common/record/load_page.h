#pragma once
/// A server's Loads as the text that Prometheus scrapes (exposition format 0.0.4), and back.

#include <cstdint>
#include <string>
#include <vector>

#include "common/codec/messages.h"

namespace seam {

struct RoomLoad {
  std::string room;
  Load load;
};

/// One metric after the other, each with a sample per room: docs/metrics.md names them.
std::string WriteLoadPage(const std::vector<RoomLoad>& loads);

/// Reads what WriteLoadPage wrote, in the order of the rooms; what it does not know is left out.
/// Times come back to the microsecond. utime and sequence are 0.
std::vector<RoomLoad> ReadLoadPage(const std::string& text);

/// "states", as the page and seam-top call a kind of traffic; kTrafficStates...
const char* TrafficName(int kind);

}  // namespace seam
