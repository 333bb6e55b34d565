#pragma once
/// Names of the scenes and the like that this program has read: no output may replace one.

#include <string>

namespace seam {

/// Remembers the first 4096 names. Safe to call from any thread.
void NoteFileRead(const std::string& path);
/// True if `path` is a noted file, also by another name.
bool WasFileRead(const std::string& path);

}  // namespace seam
