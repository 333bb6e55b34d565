#pragma once
/// The page of a server for Prometheus: what its rooms cost, the program itself, and its fleet.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/net/http_page.h"
#include "common/record/load_page.h"
#include "server/fleet/member.h"
#include "server/hub/hub.h"
#include "server/server_flags.h"

namespace seam {

/// Returns the numbers of this program: build, start, CPU time, memory and open files, named as
/// Prometheus's own clients name them.
std::string ProcessMetrics();

/// Returns the `most` rooms whose ticks were latest in their last second, the latest first.
std::vector<RoomLoad> WorstRooms(std::vector<RoomLoad> rooms, std::size_t most);

class MetricsPage {
 public:
  /// Serves nothing without --metrics. Throws OperatorError for flags that are wrong, and as
  /// HttpPage does.
  explicit MetricsPage(const ServerFlags& flags);

  /// Answers at most once in 5 ms, without waiting. `member`: nullptr: no fleet.
  void Poll(std::int64_t now_us, const Hub& hub, const FleetMember* member);

 private:
  std::unique_ptr<HttpPage> page_;  // nullptr: none
  std::size_t most_rooms_;
  std::int64_t polled_us_ = 0;
};

}  // namespace seam
