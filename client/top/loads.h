#pragma once
/// Where seam-top and seam-swarm hear how a server is: its Loads on the LCM bus, or its page.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/record/load_page.h"

namespace seam {

class Loads {
 public:
  virtual ~Loads() = default;
  /// What was told since the last call, oldest first. `now_us`: SteadyClockUs.
  virtual std::vector<RoomLoad> Take(std::int64_t now_us) = 0;
  /// The same, but of a page that was just fetched, however short the last look is ago: what it
  /// counts is of this moment. Its Load may be one that was told already.
  virtual std::vector<RoomLoad> TakeNow(std::int64_t now_us) { return Take(now_us); }
  /// Why nothing is heard, one line; "": nothing is wrong.
  virtual std::string trouble() const { return ""; }
};

/// Of all rooms on the bus. Throws OperatorError from Bus.
std::unique_ptr<Loads> LoadsOnBus(const std::string& lcm_url);

/// Of the page at "host:port", looked at once a second; a look may take half a second.
std::unique_ptr<Loads> LoadsOnPage(const std::string& address);

}  // namespace seam
