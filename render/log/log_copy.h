#pragma once
/// Copies events into a new log, with checksums of its own.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/codec/codec.h"
#include "common/record/log_file.h"
#include "common/record/room_log.h"

namespace seam {

/// Returns the seal of a chain_t or seal_t, without the checksums of the log that it stood in.
std::optional<LogSeal> SealOf(const AnyMessage& message);
/// Returns the tick that a message is of; nullopt if it is of none.
std::optional<std::int64_t> TickOfMessage(const AnyMessage& message);

/// A log that appears when it is whole.
class LogCopy {
 public:
  /// Throws OperatorError if the file is one of `read`, or exists without `force`.
  LogCopy(const std::string& path, bool force, const std::vector<std::string>& read);
  ~LogCopy();
  LogCopy(const LogCopy&) = delete;
  LogCopy& operator=(const LogCopy&) = delete;
  /// Appends an event; `message` is what its data decode to.
  void Add(const LogEvent& event, std::int64_t timestamp_us, const AnyMessage& message);
  /// Ends the log and gives it its name. Throws OperatorError if it could not be written.
  void Finish();
  /// Events of the finished log, with its seals.
  std::int64_t events() const { return events_; }

 private:
  const std::string path_, unfinished_;
  std::unique_ptr<RoomLog> log_;
  std::int64_t events_ = 0;
  std::size_t unsealed_bytes_ = 0;
};

}  // namespace seam
