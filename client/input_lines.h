#pragma once
/// Inputs from another program: a line DRIVE LIFT BUTTONS for each change, as seam-view --drive
/// prints them.

#include <string>

#include "common/scene/types.h"

namespace seam {

/// Reads lines from a file or pipe without waiting.
class InputLines {
 public:
  /// `path` "-": standard input. Throws OperatorError if it cannot be read.
  explicit InputLines(const std::string& path);
  ~InputLines();
  InputLines(const InputLines&) = delete;
  InputLines& operator=(const InputLines&) = delete;

  /// Returns the newest inputs; none once the writer is gone. Buttons that were pressed and let go
  /// since the last call count as pressed. Throws OperatorError for a line of another form.
  Input Poll();
  /// Returns the descriptor for poll(2); -1 at the end.
  int fd() const { return ended_ ? -1 : fd_; }

 private:
  const std::string path_;
  int fd_ = -1;
  bool ended_ = false;
  std::string pending_;  // the begin of a line
  Input held_;
};

}  // namespace seam
