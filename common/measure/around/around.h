#pragma once
/// The error of all views over time around one event, so that the curves of several methods can be
/// laid over each other.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/measure/measure.h"
#include "common/measure/oracle.h"
#include "common/record/recording.h"

namespace seam {

/// Time before and behind the event, s.
constexpr double kAroundBefore_s = 0.5, kAroundAfter_s = 2;

struct ErrorAround {
  std::string run;
  std::string event;  ///< contact | worst | hand-over | "tick 180"
  std::int64_t event_tick = 0;
  int tick_hz = 60;
  std::int64_t first_after = 0;  ///< of error_m, in ticks after the event; negative: before it
  /// RMS over peers' views and bodies at successive ticks, m, against the oracle at the tick that
  /// is shown.
  std::vector<double> error_m;

  /// Returns the time of an entry, s after the event.
  double After(std::size_t i) const;
};

/// `word`: contact, worst, hand-over or a tick. Throws OperatorError for another one.
void RequireEventWord(const std::string& word);

/// Returns the errors around the event of this word; nullopt where the recording has no such
/// event, or `measures` no errors. `measures`: of the recording by Measure.
std::optional<ErrorAround> FindErrorAround(const Recording& recording, const Oracle& oracle,
                                           const Measures& measures, const std::string& word);

/// Returns a line a run: the event's time, the error before it, the greatest after it, and the time
/// until at most a tenth of that is left for good.
std::string FormatAround(const std::vector<ErrorAround>& runs);
/// Returns "run,event,event_s,after_s,error_m" and a line for each run and tick.
std::string AroundCsv(const std::vector<ErrorAround>& runs);

}  // namespace seam
