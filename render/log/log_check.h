#pragma once
/// Reads a whole log: its damage, and its sessions.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/record/chain_check.h"
#include "render/log/longest_run.h"

namespace seam {

/// A session as far as a log has it.
struct SessionSpan {
  std::int64_t events = 0, bytes = 0;
  std::int64_t happened = 0;                    ///< Event messages
  LongestRun us{3600000000};                    ///< timestamps
  LongestRun ticks{100000};                     ///< of the views
};

struct LogCheck {
  std::int64_t events = 0, bytes = 0, seals = 0;
  std::int64_t keyed = 0;        ///< seals with a keyed hash
  std::int64_t foreign = 0;      ///< events of other channels
  std::int64_t undecodable = 0;  ///< of ours
  std::int64_t skipped_bytes = 0;
  /// Tick behind which it begins, if its first segments are not there.
  std::optional<std::int64_t> begins_after;
  std::int64_t missing = 0;  ///< messages, by their numbers
  std::vector<DamagedRange> damage;
  std::map<std::string, std::map<std::int64_t, SessionSpan>> rooms;  ///< by name and session

  bool damaged() const { return skipped_bytes > 0 || undecodable > 0 || !damage.empty(); }
};

/// `key`: see LogReader. Throws OperatorError if there is no such log.
LogCheck CheckLog(const std::string& path, const Secret* key = nullptr);
/// Returns a line for each damaged part of a log.
std::vector<std::string> LinesOf(const LogCheck& check);

}  // namespace seam
