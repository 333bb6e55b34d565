#pragma once
/// A room that is done again from its log alone, by a real Server without clients.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/net/memory.h"
#include "common/record/recording.h"
#include "common/record/tick_splitter.h"
#include "server/server.h"

namespace seam {

/// The server's ticks of a room in a log: of one session, or of all in which it went on.
struct LoggedRoom {
  Recording recording;
  std::vector<TickMessages> ticks;  ///< ascending, without gaps
};

/// Reads a log; `session` as for ReadRecording, but that "" also takes the sessions before with
/// which the last one goes on, after --resume. Throws OperatorError if it does not hold all ticks
/// of the room from the first on, with their hashes: it was not written by --record, --state or
/// seam-lab of 0.26 or later, or it begins later or has gaps.
LoggedRoom ReadLoggedRoom(const std::string& path, const std::string& session);

class ReplayedRoom {
 public:
  /// `out` gets what is done again, as the log of another session; nullptr: nothing does.
  explicit ReplayedRoom(const LoggedRoom& logged, Recorder* out = nullptr);
  ~ReplayedRoom();

  /// Result of a tick.
  enum class Tick { kSame, kOtherWorld, kOtherValues };
  /// Does the next tick of the log.
  Tick Step();
  bool done() const { return next_ == logged_.ticks.size(); }
  /// Number of ticks that were done.
  std::size_t next() const { return next_; }
  Server& server() { return *server_; }

 private:
  class Silence;

  const LoggedRoom& logged_;
  Recorder* const out_;
  std::size_t next_ = 0;
  MemoryNetwork network_;
  SeededEntropy entropy_{1};
  std::unique_ptr<Net> net_;
  std::unique_ptr<Silence> silence_;
  std::unique_ptr<Server> server_;
};

}  // namespace seam
