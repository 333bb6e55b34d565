#pragma once
/// Progress of a counted task in one ProgressLine: name, count, total, rate and time left.

#include <cstdint>
#include <string>

#include "common/base/progress_line.h"

namespace seam {

/// Returns "sweep: 12 of 400 runs (3 %), 3.2 runs/s, 2 min 1 s left" after `elapsed_s` seconds. The
/// rate is the mean since the start; it is left out while `done` is 0 and in the first 0.2 s.
/// `total` 0 means unknown: "search: 12 trials, 3.2 trials/s".
std::string ProgressText(const std::string& what, const std::string& unit, std::int64_t done,
                         std::int64_t total, double elapsed_s);

/// Formats a duration: "950 ms", "12 s", "2 min 1 s", "3 h 20 min".
std::string SpanText(double seconds);

class ProgressCount {
 public:
  /// Counts task `what` in `unit` ("runs") up to `total`, 0 if unknown. Starts the time.
  ProgressCount(std::string what, std::string unit, std::int64_t total, bool quiet = false);

  /// Reports that `done` units are complete; cheap when no line is due.
  void operator()(std::int64_t done);
  /// Ends the line so that other text can follow on the terminal; the next is due as before.
  void End() { line_.End(); }
  double elapsed_s() const;

 private:
  std::string what_, unit_;
  std::int64_t total_;
  ProgressLine line_;
  std::int64_t begin_us_;
};

}  // namespace seam
