#pragma once
/// Logs that are being written, read as they grow, in the order of their times.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/record/log_file.h"

namespace seam {

class LogTails {
 public:
  /// The paths are as for LogReader. Throws OperatorError for one that is something else. A file
  /// that does not exist yet is waited for.
  explicit LogTails(const std::vector<std::string>& paths);

  /// Returns the next event of all logs; false when there is none now. A log that is cut is read
  /// anew from its begin.
  bool Next(LogEvent* event);

 private:
  struct Tail {
    std::string path;  // of the log, all its segments
    LogPlace place;  // behind the last event read
    std::unique_ptr<LogReader> reader;
    std::optional<LogEvent> next;
  };
  static void Fill(Tail* tail);

  std::vector<Tail> tails_;
};

}  // namespace seam
