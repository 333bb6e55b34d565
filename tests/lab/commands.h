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

struct DivergenceCommand {
  std::string log_a, log_b;
  int peer = -1;                      ///< -1: all
  bool common = false;                ///< only the views that both have
};

/// Prints the first difference of two recordings' views. 0: equal; 1: they differ.
int FirstDivergence(const DivergenceCommand& command);

}  // namespace seam
