#pragma once
/// A section of a recording in seconds of its timeline, as given by --from and --to.

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "common/record/recording.h"

namespace seam {

/// A closed interval. NaN means the recording's own start or end.
struct TimeRange {
  double from_s = std::numeric_limits<double>::quiet_NaN();
  double to_s = std::numeric_limits<double>::quiet_NaN();

  bool given() const { return !std::isnan(from_s) || !std::isnan(to_s); }
  /// Returns true if the time of the state after `tick`, tick / tick_hz, is in the range, to a
  /// millionth of a second.
  bool Holds(std::int64_t tick, int tick_hz) const;
};

/// Throws OperatorError when --from is after --to, or the recording has no view between them.
void RequireRange(const TimeRange& range, const Recording& recording, const std::string& path);

/// Removes the views, strands, impacts, statistics, loads and events outside the range and sets
/// first_tick and last_tick. Everything else (scene, edits, grants, inputs ...) stays as context.
/// Compute an oracle from the whole recording, never from a section. Requires RequireRange.
void KeepRange(const TimeRange& range, Recording* recording);

/// Returns "12 damaged bytes skipped, 0 events undecodable, 3 messages missing"; "" for an intact
/// log.
std::string DamageOf(const Recording& recording);

}  // namespace seam
