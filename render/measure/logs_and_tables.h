#pragma once
/// Names of logs, and the files that seam-measure writes.

#include <string>

#include "common/record/recording.h"

namespace seam {

/// Returns the name of a log: "out/demo/buffer.lcm" -> "buffer".
std::string BaseName(const std::string& path);

/// Returns the changes that an operator made while the session ran, "network is now 4g at 3.2 s,
/// and 5 more"; "" without any.
std::string ChangesOf(const Recording& recording);

/// Returns the first line of a file (at most 1000 bytes); empty when there is no such file.
std::string FirstLine(const std::string& path);

/// Replaces a file by a text. Throws OperatorError if it cannot be written.
void WriteText(const std::string& path, const std::string& text);

}  // namespace seam
