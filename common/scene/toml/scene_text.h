#pragma once
/// Checks of a scene file before parsing: short, UTF-8, without control characters, and not nested
/// so deeply that a recursive parser runs out of stack.

#include <string>

namespace seam {

/// Length of a scene. A parser needs about a second for 1 MB.
constexpr std::size_t kSceneBytesMax = 4000000;
/// Depth of nested brackets; the format needs at most 5.
constexpr int kSceneNestingMax = 12;
/// Number of dots in one key.
constexpr int kSceneDotsMax = 4;

/// Throws OperatorError "file:line: FAULT" at the first fault.
void CheckSceneText(const std::string& text, const std::string& file);

/// Returns `text` safe to print: all but printable ASCII replaced by '?', cut at 80 characters.
std::string Printable(const std::string& text);

/// True for UTF-8 (RFC 3629: no surrogates, no over-long forms) without control characters other
/// than those in `allowed`.
bool IsCleanText(const std::string& text, const std::string& allowed);

}  // namespace seam
