#pragma once
/// A stretch of a recording in seconds of its timeline, as --from and --to say it.

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "common/record/recording.h"

namespace seam {

/// Both ends belong to it. NaN: as far as the recording goes.
struct TimeRange {
  double from_s = std::numeric_limits<double>::quiet_NaN();
  double to_s = std::numeric_limits<double>::quiet_NaN();

  bool given() const { return !std::isnan(from_s) || !std::isnan(to_s); }
  /// Whether the state after `tick` belongs to it: tick / tick_hz, to a millionth of a second.
  bool Holds(std::int64_t tick, int tick_hz) const;
};

/// Throws OperatorError when --from is after --to, or nothing of the recording lies between them.
void RequireRange(const TimeRange& range, const Recording& recording, const std::string& path);

/// Takes away the views, strands, impacts, statistics and events outside of the range, and sets
/// first_tick and last_tick. Scene, edits, grants, meta and inputs stay: they say what the rest
/// means. What an oracle is computed from must be the whole recording. Requires RequireRange.
void KeepRange(const TimeRange& range, Recording* recording);

/// "12 damaged bytes skipped, 0 events undecodable, 3 messages missing"; "" of a whole log.
std::string DamageOf(const Recording& recording);

}  // namespace seam
