#pragma once
/// Sources of a server's Loads for seam-top and seam-swarm: the LCM bus, or the server's page.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/record/load_page.h"

namespace seam {

class Loads {
 public:
  virtual ~Loads() = default;
  /// Returns the loads since the last call, oldest first. `now_us`: SteadyClockUs.
  virtual std::vector<RoomLoad> Take(std::int64_t now_us) = 0;
  /// Like Take, but fetches the page now, however recent the last fetch is: its counters are
  /// current. Its Load may have been returned before.
  virtual std::vector<RoomLoad> TakeNow(std::int64_t now_us) { return Take(now_us); }
  /// Returns one line that says why nothing is received; "": nothing is wrong.
  virtual std::string trouble() const { return ""; }
};

/// Returns the loads of all rooms on the bus. Throws OperatorError from Bus.
std::unique_ptr<Loads> LoadsOnBus(const std::string& lcm_url);

/// Returns the loads of the page at "host:port", fetched once a second; a fetch may take half a
/// second.
std::unique_ptr<Loads> LoadsOnPage(const std::string& address);

}  // namespace seam
