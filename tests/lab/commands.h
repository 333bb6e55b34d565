#pragma once
/// The commands of seam-lab. Each returns the program's exit status and throws OperatorError, with
/// nothing written, for what the operator can put right.

#include <string>

#include "tests/lab/session.h"

namespace seam {

struct RunCommand {
  SessionSettings settings;
  std::string smooth = "on";          ///< on | off
  std::string log;                    ///< file to write
  bool force = false;                 ///< overwrite it
};

/// Records a session and prints its simulated and wall seconds in one line.
int RunLog(const RunCommand& command);

}  // namespace seam
