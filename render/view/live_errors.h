#pragma once
/// The errors of a running session's views against an oracle that is simulated beside it.

#include <cstdint>
#include <string>
#include <vector>

#include "common/measure/growing_oracle.h"
#include "common/record/recording.h"

namespace seam {

/// The error of one view at one tick.
struct LiveError {
  int peer = 0;
  std::int64_t tick = 0;
  double error_m = 0;  ///< RMS over the bodies, at the ticks that are shown
};

class LiveErrors {
 public:
  /// Requires a recording with a scene. Throws OperatorError for a scene that does not parse.
  explicit LiveErrors(const Recording& recording);

  /// Takes over what is new in the recording; call it before anything of it is forgotten.
  void Hear(const Recording& recording) { oracle_.Hear(recording); }
  /// Simulates ticks up to a second before the newest, when their inputs are known, for at most
  /// about a third of the time, and adds the errors at these ticks.
  void Advance(const Recording& recording, std::int64_t newest_tick);
  /// Returns the errors that are known, by tick.
  const std::vector<LiveError>& errors() const { return errors_; }
  /// Forgets the errors of all ticks before this one.
  void Forget(std::int64_t before_tick);

  /// Returns the seconds by which the oracle is later than it should be.
  double behind_s(std::int64_t newest_tick) const;
  const Oracle& oracle() const { return oracle_.oracle(); }

 private:
  void MeasureAt(const Recording& recording);

  GrowingOracle oracle_;
  const std::int64_t hz_;
  std::vector<LiveError> errors_;
  std::size_t identified_ = 0;  // edits of the recording when parts were last matched
};

}  // namespace seam
