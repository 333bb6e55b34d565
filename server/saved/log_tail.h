#pragma once
/// The end of a room's log, after its snapshot: all that the server had accepted since. LogFollower
/// reads it while another server still writes it, ReadLogTail once.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/base/status.h"
#include "common/codec/messages.h"
#include "common/record/room_log.h"
#include "common/record/tick_splitter.h"

namespace seam {

struct LogTail {
  std::vector<TickMessages> ticks;  ///< one after another, as Server::Replay does them again
  std::vector<AnyMessage> begun;    ///< accepted for the tick after them, which was not stepped
  LogPlace end;                     ///< where the log is to go on
  std::optional<Summary> summary;   ///< the newest one of the session that wrote the log
  std::string damage;               ///< one line if more follows `end` than a tick that was cut off
  std::int32_t damaged_segment = 0;  ///< of the log, in which that is
  /// Players that were in the room before `ticks`, beside those that are in the saved room.
  std::vector<int> present;
};

class LogFollower {
 public:
  /// `from`: a place that is kept, behind tick `tick`. `key`: written with it, nullptr: with any or
  /// none; must outlive this.
  LogFollower(std::string path, std::string room, const LogPlace& from, std::int64_t tick,
              const Secret* key);

  /// Reads the whole ticks that were not in an earlier call's `tail`, up to the end of the log or
  /// the first thing that is not as it was written. While the log is being written that may be a
  /// tick of which a part is there: the next call reads it again. What the end of a room adds to a
  /// tick that was read is in `begun`. Returns one line if there is no
  /// such place in the log.
  Status Read(LogTail* tail);
  /// The last tick that was read.
  std::int64_t tick() const { return tick_; }

 private:
  /// Returns the records accepted behind the last tick.
  std::vector<AnyMessage> Begun(const TickSplitter& splitter) const;

  const std::string path_, room_;
  const Secret* const key_;
  std::int64_t tick_;
  std::size_t after_ = SIZE_MAX;  // messages behind that tick's step, as it was read
  std::vector<AnyMessage> late_;  // that it has more
  // The last seal over which nothing is written any more, and the splitter behind it.
  LogPlace kept_;
  TickSplitter splitter_;
};

/// Does so once: reads the log from `from` on, which is behind tick `tick`, up to the first thing
/// that is not as it was written. `key`: written with it, nullptr: with any or none. Returns one
/// line if there is no such place in the log.
Status ReadLogTail(const std::string& path, const std::string& room, const LogPlace& from,
                   std::int64_t tick, const Secret* key, LogTail* tail);

}  // namespace seam
