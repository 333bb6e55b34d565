#pragma once
/// Finds out from a recording alone whose bodies moved otherwise than by physics: a SpareWorld
/// begins at the server's view of a tick, is stepped with the recorded inputs, and is compared with
/// the server's view kWindowS later.

#include <string>
#include <vector>

#include "common/record/recording.h"

namespace seam {

/// Mechanisms of one peer that met nobody else's meanwhile.
struct AuditedPeer {
  int peer = 0;
  int player = -1;         ///< by the session's sum; -1: unknown
  int windows = 0;         ///< mechanisms that were compared, once in each window
  double gain_mps2 = 0;    ///< mean speed that they gained beside physics, in each second
  double error_mps2 = 0;   ///< standard error of that
  double largest_mps = 0;  ///< largest difference of velocities in one window
  /// True if the gain is no chance: kErrors standard errors, and kGainMin. A car that begins
  /// without its contact forces gains up to .09 m/s2 by that.
  bool lies() const;

  static constexpr double kErrors = 5, kGainMin = 0.15;  // -, m/s2
  static constexpr int kWindowsMin = 10;
};

/// Length of a window, s: long enough that a lie is more than the wire's rounding, short enough
/// that chaos has not begun.
constexpr double kWindowS = 0.2;

/// Returns the peers that held moving bodies, ascending. Requires a recording with the server's
/// views; throws OperatorError as RecordedScene does.
std::vector<AuditedPeer> AuditRecording(const Recording& recording);
/// Returns a line for each, after a line with the column names; "nothing to compare" if none.
std::string FormatAudit(const std::vector<AuditedPeer>& peers, const Recording& recording);

}  // namespace seam
