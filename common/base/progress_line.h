#pragma once
/// How far a program is: one line on a terminal that renews itself. Silent when stderr is no
/// terminal, so that no log file holds it.

#include <cstddef>
#include <cstdint>
#include <string>

namespace seam {

class ProgressLine {
 public:
  /// Renews itself every `every_us` at most; never when `quiet`.
  explicit ProgressLine(bool quiet = false, std::int64_t every_us = 1000000);
  /// Ends.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Whether the line is to be renewed at `now_us` (SteadyClockUs); false on anything but a
  /// terminal. The first line is due at once.
  bool Due(std::int64_t now_us) const { return shown_ && now_us >= next_us_; }
  /// Shows `text` (one line) in place of the last one; what the terminal is too narrow for is cut
  /// off. Requires Due(now_us).
  void Show(std::int64_t now_us, const std::string& text);
  /// Ends the line, if there is one: what is written next begins a line of its own.
  void End();

 private:
  bool shown_;
  std::int64_t every_us_;
  std::int64_t next_us_ = 0;
  std::size_t columns_ = 0;  // of the line that stands there
};

}  // namespace seam
