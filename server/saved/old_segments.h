#pragma once
/// Removes what a kept room's log has of long ago.

#include <cstdint>
#include <string>

namespace seam {

/// Parses a time for which logs are kept, "7d", "12h" or "30m", into seconds. Throws OperatorError.
std::int64_t ParseKeep(const std::string& text);

/// Removes the segments of a room's log to which nothing was written for `keep_s`, and from which
/// no snapshot of the room goes on. Returns a line that says so; "" if there are none.
std::string RemoveOldSegments(const std::string& folder, const std::string& room,
                              std::int32_t epoch, std::int64_t keep_s);

}  // namespace seam
