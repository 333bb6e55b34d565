#pragma once
/// The line about a log without a room.

#include <string>

namespace seam {

/// `room`: the wanted one, or "". `ours`: it has messages of a room, as a client's log has, which
/// only lacks the room itself.
inline std::string WhyNoRoom(const std::string& room, bool ours) {
  if (!room.empty()) return "no room \"" + room + "\" in this log (record channels SEAM.*)";
  if (!ours) return "no Seam2D room in this log (record channels SEAM.*)";
  return "no Seam2D room in this log, as in a client's: its server's has it (seam-log merge "
         "SERVER.lcm CLIENT.lcm -o both.lcm)";
}

}  // namespace seam
