#pragma once
/// The sessions in a log: a logger that runs on while a server is started anew records several.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/codec/messages.h"

namespace seam {

/// One session of a room in a log.
struct LogSession {
  std::int64_t id = 0;      ///< Room::session; 0: recorded before protocol 13, which had none
  Room room;                ///< its first
  std::int64_t events = 0;  ///< LCM events
};

/// Returns the sessions of a room in a log ("": the room of the first message of the bus), in the
/// order of their first message; sessions without a Room are left out, as they cannot be drawn.
/// Throws OperatorError when there is no such file.
std::vector<LogSession> ListSessions(const std::string& path, const std::string& room);

/// Returns the index of the chosen session: `choice` is its number in the list, from 1, or its id
/// as 16 hexadecimal digits; "" is the last. Throws OperatorError that lists the sessions. Requires
/// a session.
std::size_t ChooseSession(const std::vector<LogSession>& sessions, const std::string& choice,
                          const std::string& path);

/// Returns "2 sessions: 1 (buffer/fade, 4g, seed 2, 1200 events), 2 (...)".
std::string SessionsText(const std::vector<LogSession>& sessions);

/// Checks the values of --session. Throws OperatorError unless there are none or one for each log.
void CheckSessions(const std::vector<std::string>& choices, std::size_t logs);

/// Returns the line about a log without a room. `room`: the wanted one, or "". `ours`: it has
/// messages of a room, as a client's log has, which only lacks the room itself.
inline std::string WhyNoRoom(const std::string& room, bool ours) {
  if (!room.empty()) return "no room \"" + room + "\" in this log (record channels SEAM.*)";
  if (!ours) return "no Seam2D room in this log (record channels SEAM.*)";
  return "no Seam2D room in this log, as in a client's: its server's has it (seam-log merge "
         "SERVER.lcm CLIENT.lcm -o both.lcm)";
}

}  // namespace seam
