#pragma once
/// The end of a room's log, after its snapshot: what the server had accepted since.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/base/status.h"
#include "common/codec/messages.h"
#include "common/record/room_log.h"

namespace seam {

/// Messages of a tick, as Server::Resume does them again.
struct LogTick {
  std::vector<Inputs> inputs;    ///< to record before the step
  std::vector<States> states;    ///< of clients, to receive before it
  std::vector<EditOrder> edits;  ///< ordered in it
  std::vector<Grants> grants;    ///< made after the step
  std::vector<Meta> values;      ///< values after it
};

/// Messages of the log by tick.
struct LogTail {
  std::map<std::int64_t, LogTick> ticks;
  std::int64_t last_tick = -1;  ///< last one whose end is in the log; -1: none
  LogPlace end;                 ///< where the log is to go on
  std::optional<Summary> summary;  ///< the newest one of the session that wrote the log
  std::map<int, bool> here;        ///< players that came (true) or left since, as of the end
  std::string damage;           ///< one line if more follows `end` than a tick that was cut off
};

/// Reads the log from `from` on, up to the first thing that is not as it was written. A late input
/// is in the tick in which it acts, so that no tick has to be stepped again. `key`: written with
/// it, nullptr: with any or none. Returns one line if there is no such place in the log.
Status ReadLogTail(const std::string& path, const std::string& room, const LogPlace& from,
                   const Secret* key, LogTail* tail);

}  // namespace seam
