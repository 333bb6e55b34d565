#pragma once
/// Reports damage of recordings: every program that reads one names each damaged part on stderr,
/// and ends with status 1.

#include <string>
#include <vector>

#include "common/record/recording.h"

namespace seam {

/// What is said of a part whose checksums are right, but for those of the key.
constexpr const char* kForgedWords = ": changed, or not written with this key";

/// Returns true if bytes of the log are not as they were written. Missing messages alone are none:
/// a logger may miss some.
bool IsDamaged(const Recording& recording);

/// Returns a line for each damaged part: "ticks 120 to 121 are damaged (SEAM.main.view.0, ...)",
/// and one with DamageOf; empty for an intact log.
std::vector<std::string> DamageLines(const Recording& recording);

/// Returns the same in a few words, for a picture: "ticks 120 to 121 are damaged and 2 more"; ""
/// for an intact log.
std::string DamageNote(const Recording& recording);

/// Prints these lines to stderr as warnings of `program`, once for each `path` and session, and
/// remembers that there was damage. For main threads.
void ReportDamage(const char* program, const std::string& path, const Recording& recording);

/// Returns the exit status of a program that would end with `status`: 1 instead of 0 if
/// ReportDamage has found damage.
int StatusAfterReading(int status);

}  // namespace seam
