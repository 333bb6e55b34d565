#pragma once
/// How far a program is with what it counts: what, how much of how much, rate, time left, in the
/// one line of ProgressLine.

#include <cstdint>
#include <string>

#include "common/base/progress_line.h"

namespace seam {

/// "sweep: 12 of 400 runs (3 %), 3.2 runs/s, 2 min 1 s left" after `elapsed_s` seconds; the rate is
/// the mean since the beginning. Before the first is done, and in the first 0.2 s,
/// there is no rate. `total` 0: not known,
/// "search: 12 trials, 3.2 trials/s".
std::string ProgressText(const std::string& what, const std::string& unit, std::int64_t done,
                         std::int64_t total, double elapsed_s);

/// "950 ms", "12 s", "2 min 1 s", "3 h 20 min".
std::string SpanText(double seconds);

class ProgressCount {
 public:
  /// `what` is counted in `unit`, "runs", up to `total`; 0: not known. Time counts from here.
  ProgressCount(std::string what, std::string unit, std::int64_t total, bool quiet = false);

  /// So many are done; cheap when no line is due.
  void operator()(std::int64_t done);
  /// Ends the line, so that another can be written to the terminal; the next one is due as before.
  void End() { line_.End(); }
  double elapsed_s() const;

 private:
  std::string what_, unit_;
  std::int64_t total_;
  ProgressLine line_;
  std::int64_t begin_us_;
};

}  // namespace seam
