#pragma once
/// A progress line that is rewritten in place on a terminal. Silent when stderr is no terminal, so
/// that it never gets into a log file.

#include <cstddef>
#include <cstdint>
#include <string>

namespace seam {

class ProgressLine {
 public:
  /// Updates at most once in `every_us`; never when `quiet`.
  explicit ProgressLine(bool quiet = false, std::int64_t every_us = 1000000);
  /// Calls End.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Returns true if an update is due at `now_us` (SteadyClockUs); always false without a terminal.
  /// The first update is due at once.
  bool Due(std::int64_t now_us) const { return shown_ && now_us >= next_us_; }
  /// Replaces the line by `text` (one line), cut to the terminal's width. Requires Due(now_us).
  void Show(std::int64_t now_us, const std::string& text);
  /// Ends the line, if there is one, so that the next text begins a line of its own.
  void End();

 private:
  bool shown_;
  std::int64_t every_us_;
  std::int64_t next_us_ = 0;
  std::size_t columns_ = 0;  // width of the line on the terminal, 0: none
};

}  // namespace seam
