#pragma once
/// The commands of seam-log. Each returns the program's exit status: 1 if a log is damaged. Throws
/// OperatorError for mistakes that the operator can correct, with nothing written.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/record/time_range.h"

namespace seam {

struct LogsCommand {
  std::vector<std::string> logs;
};

struct LogVerifyCommand {
  std::vector<std::string> logs;
  std::string log_key;  ///< a key file; "": none
};

/// Prints the sessions of logs: room, scene, method, ticks, duration, events and bytes.
int RunLogList(const LogsCommand& command);
/// Prints for each log that it is whole, or its damage, a line for each part. With a key, also
/// which parts were not written with it.
int RunLogVerify(const LogVerifyCommand& command);

struct LogStatsCommand {
  std::string log, room, session;
  bool csv = false;
};

/// Prints events, rate, bytes, longest pause and missing messages of each channel of a session, and
/// then what is missing over time (FindLosses).
int RunLogStats(const LogStatsCommand& command);

struct LogEventsCommand {
  std::string log, room, session;
  bool json = false;
};

/// Prints the events of a session, a line each, and its newest sum; or, as JSON, an object on each
/// line.
int RunLogEvents(const LogEventsCommand& command);

/// Prints the fingerprint of every LCM type, with and without its session.
int RunLogTypes();

struct LogTopCommand {
  std::string store, scene, by = "score";
  int limit = 10;
};

/// Prints the leaderboard of a database of seam-server --store, and the newest past sessions.
int RunLogTop(const LogTopCommand& command);

struct LogCutCommand {
  std::string log, out, room, session;
  TimeRange range;
  std::optional<int> from_tick, to_tick;
  bool force = false;
};

/// Writes a part of one session as a log with checksums of its own. What its readers need of before
/// it stays: scene, edits, inputs, grants and values. Refuses a part with damage.
int RunLogCut(const LogCutCommand& command);

struct LogMergeCommand {
  std::vector<std::string> logs;
  std::string out;
  bool force = false;
};

/// Writes the events of several logs in the order of time, each message once. A log's clock is
/// compared with the first one's by the messages that both have. Refuses damaged logs.
int RunLogMerge(const LogMergeCommand& command);

}  // namespace seam
